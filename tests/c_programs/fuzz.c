/* Damaged tables, each in memory of its own and exactly as long as it is, for a compiler that watches every access.

   fuzz FILE SEED MIXES: refuses each truncation, each longer file and three changes of each byte. The same changes under a
   checksum that agrees may be refused or not; what is opened is asked for all that it has. */
#include "asking.h"

static void refused(const unsigned char *bytes, size_t size, const char *what, size_t place)
{
    if (opened(bytes, size) == PENDULAR_TABLE_OK) {
        printf("opened with %s %lu\n", what, (unsigned long)place);
        exit(1);
    }
}

static void tell(const char *what)
{
    int code;
    printf("%s:", what);
    for (code = 0; code < CODES; ++code) {
        if (counted[code])
            printf(" %lu x %s;", counted[code], pendular_table_error(code));
        counted[code] = 0;
    }
    printf("\n");
}

int main(int count, char **words)
{
    const unsigned char changes[] = { 0x01, 0x80, 0xff };
    FILE *file = count == 4 ? fopen(words[1], "rb") : NULL;
    unsigned char *whole, *bytes;
    size_t size, i, j, headers;
    unsigned long mixes, k;
    pendular_table table;
    if (!file)
        return 2;
    state = strtoul(words[2], NULL, 10) * 2654435761u + 88172645463325252u;
    mixes = strtoul(words[3], NULL, 10);
    whole = (unsigned char *)malloc(1 << 24);
    bytes = (unsigned char *)malloc(1 << 24);
    if (!whole || !bytes)
        return 2;
    memset(whole, 0, 1 << 24);
    size = fread(whole, 1, (1 << 24) - 64, file);
    fclose(file);
    if (opened(whole, size) != PENDULAR_TABLE_OK || pendular_table_view(whole, size, &table) != PENDULAR_TABLE_OK)
        return 1;
    headers = (size_t)((const unsigned char *)table.channel[0].coefficients - whole);
    tell("whole");
    for (i = 0; i < size; ++i)
        refused(whole, i, "length", i);
    for (i = 1; i <= 64; ++i)
        refused(whole, size + i, "length", size + i);
    tell("cut or longer");
    memcpy(bytes, whole, size);
    for (i = 0; i < size; ++i) {
        for (j = 0; j < sizeof changes; ++j) {
            bytes[i] ^= changes[j];
            refused(bytes, size, "a change of byte", i);
            bytes[i] = whole[i];
        }
    }
    tell("each byte");
    for (i = 24; i < headers; ++i) {
        for (j = 0; j < sizeof changes; ++j) {
            bytes[i] ^= changes[j];
            seal(bytes, size);
            opened(bytes, size);
            bytes[i] = whole[i];
        }
    }
    tell("each byte of the headers, sealed");
    for (k = 0; k < mixes; ++k) {
        const size_t length = dice() % 4 ? size : 200 + dice() % (size + 800);
        memcpy(bytes, whole, size);
        memset(bytes + size, 0, 1024);
        for (j = 1 + dice() % 4; j > 0; --j) {
            const size_t place = 24 + 4 * (dice() % ((headers - 24) / 4));
            const int32_t numbers[] = { 0, 1, -1, 2, 1 << 30, 0x7fffffff, 0x7ff00000, (int32_t)dice() };
            memcpy(bytes + place, &numbers[dice() % 8], sizeof(int32_t));
        }
        seal(bytes, length);
        opened(bytes, length);
    }
    tell("mixed, sealed");
    free(whole);
    free(bytes);
    return 0;
}
