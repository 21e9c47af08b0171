/* Threads that ask one open table at once, for a compiler that watches who reads and writes what.

   threads FILE: each of them has the bits of one that asks alone. */
#include <pthread.h>

#include "pendular_table.h"

enum { THREADS = 8, CONTACTS = 2000, ANSWERS = 5 };

static pendular_table table;

static void ask_all(double *out)
{
    const int asked[ANSWERS] = { PENDULAR_TABLE_RUPTURE_DISTANCE, PENDULAR_TABLE_FORCE, PENDULAR_TABLE_LIQUID,
        PENDULAR_TABLE_STIFFNESS, PENDULAR_TABLE_ENERGY };
    int i, j;
    for (i = 0; i < CONTACTS; ++i) {
        const double star = table.low * pow(table.high / table.low, (i % 37) / 36.0), radius1 = 1e-4;
        const double radius2 = radius1 * (1.0 + (i % 11) * 0.09), mean = 2.0 / (1.0 / radius1 + 1.0 / radius2);
        const double control = table.is_volume ? star * mean * mean * mean : 0.07 * star / mean;
        for (j = 0; j < ANSWERS; ++j)
            *out++ = pendular_table_value(&table, asked[j], 1e-8 * (i % 101), control, radius1, radius2, 0.07);
    }
}

static void *in_thread(void *out)
{
    ask_all((double *)out);
    return NULL;
}

int main(int count, char **words)
{
    static double alone[CONTACTS * ANSWERS], each[THREADS][CONTACTS * ANSWERS];
    pthread_t threads[THREADS];
    int i, bridges = 0;
    if (count != 2 || pendular_table_open(words[1], &table) != PENDULAR_TABLE_OK)
        return 2;
    for (i = 0; i < THREADS; ++i)
        if (pthread_create(&threads[i], NULL, in_thread, each[i]) != 0)
            return 3;
    ask_all(alone);
    for (i = 0; i < THREADS; ++i)
        pthread_join(threads[i], NULL);
    for (i = 0; i < THREADS; ++i)
        if (memcmp(each[i], alone, sizeof alone) != 0)
            return 1;
    for (i = 0; i < CONTACTS; ++i)
        bridges += alone[ANSWERS * i + 1] > 0.0;
    printf("%d of %d contacts have a bridge\n", bridges, CONTACTS);
    pendular_table_close(&table);
    return 0;
}
