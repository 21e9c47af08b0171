/* What libFuzzer calls: bytes as they are, which are hardly ever a table, and the same under a size and a checksum that
   agree, which let the reader go on to all that it has to look at. */
#include "asking.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    unsigned char *bytes;
    opened(data, size);
    if (size < PENDULAR_TABLE_HEADER + PENDULAR_TABLE_CHECKSUM)
        return 0;
    bytes = (unsigned char *)malloc(size);
    if (!bytes)
        return 0;
    memcpy(bytes, data, size);
    seal(bytes, size);
    opened(bytes, size);
    free(bytes);
    return 0;
}
