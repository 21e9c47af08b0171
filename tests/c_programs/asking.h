/* A table of any bytes, in memory of its own and exactly as long as it is, asked for all that it has if it opens. */
#include "pendular_table.h"

enum { CODES = 13, CONTACTS = 40 };

static uint64_t state;
static unsigned long counted[CODES];

static uint64_t dice(void)
{
    state ^= state << 13;
    state ^= state >> 7;
    state ^= state << 17;
    return state;
}

static double uniform(void)
{
    return (double)(dice() >> 11) / 9007199254740992.0;
}

static void seal(unsigned char *bytes, size_t size)
{
    const uint64_t length = size;
    uint32_t checksum;
    memcpy(bytes + 16, &length, sizeof length);
    checksum = pendular_table_crc32(bytes, size - PENDULAR_TABLE_CHECKSUM);
    memcpy(bytes + size - PENDULAR_TABLE_CHECKSUM, &checksum, sizeof checksum);
}

/* Contacts inside and beyond the range, and numbers that are none. */
static double sometimes_odd(double number)
{
    const double odd[] = { NAN, INFINITY, -INFINITY, 0.0, -1.0, 1e308, 5e-324 };
    return dice() % 16 == 0 ? odd[dice() % (sizeof odd / sizeof *odd)] : number;
}

static double ask_all(const pendular_table *table)
{
    double sum = 0.0;
    int i, asked;
    for (i = 0; i < CONTACTS; ++i) {
        const double star = table->low * pow(table->high / table->low, 1.2 * uniform() - 0.1);
        const double ratio
            = table->least_ratio + (table->largest_ratio - table->least_ratio) * (1.2 * uniform() - 0.1);
        const double large = ratio > 0.0 ? 1e-4 / ratio : INFINITY, mean = 2e-4 / (1.0 + ratio);
        const double control = sometimes_odd(table->is_volume ? star * mean * mean * mean : 0.07 * star / mean);
        const double radius1 = sometimes_odd(i % 2 ? 1e-4 : large), radius2 = sometimes_odd(i % 2 ? large : 1e-4);
        const double rupture = pendular_table_rupture_distance(table, control, radius1, radius2, 0.07);
        const double separation = sometimes_odd(rupture * (1.2 * uniform() - 0.1));
        for (asked = -3; asked <= table->channels; ++asked) {
            const double value
                = pendular_table_value(table, asked, separation, control, radius1, radius2, sometimes_odd(0.07));
            sum += value == value ? 1.0 : 0.0;
        }
    }
    return sum;
}

/* The code of a table of these bytes; it is asked if it opens. */
static int opened(const unsigned char *bytes, size_t size)
{
    unsigned char *own = (unsigned char *)malloc(size ? size : 1);
    pendular_table table;
    int code;
    if (!own)
        exit(3);
    memcpy(own, bytes, size);
    code = pendular_table_view(own, size, &table);
    if (code == PENDULAR_TABLE_OK && ask_all(&table) < 0.0)
        exit(3);
    free(own);
    if (code < 0 || code >= CODES)
        exit(4);
    ++counted[code];
    return code;
}
