/* Functions of pendular_table.h as a shared library, for the tests. */
#include "pendular_table.h"

#ifdef __cplusplus
#define SHARED extern "C"
#else
#define SHARED
#endif

SHARED size_t size_of_table(void);
SHARED const char *error_of(int code);
SHARED int open_bytes(const void *bytes, size_t size, pendular_table *table);
SHARED const char *text_of(const pendular_table *table, int channel, int which);
SHARED double bound_of(const pendular_table *table, int channel);
SHARED int channel_of(const pendular_table *table, const char *name);
SHARED void moved_to(const pendular_table *table, const void *bytes, pendular_table *moved);
SHARED void ask(const pendular_table *table, int asked, size_t count, const double *separation, const double *control,
    const double *radius1, const double *radius2, const double *surface_tension, double *out);
SHARED void ask_block(const pendular_table *table, int asked, size_t count, const double *separation,
    const double *control, const double *radius1, const double *radius2, double surface_tension, double *out);
SHARED double ask_by_name(const pendular_table *table, int asked, double separation, double control, double radius1,
    double radius2, double surface_tension);

size_t size_of_table(void)
{
    return sizeof(pendular_table);
}

const char *error_of(int code)
{
    return pendular_table_error(code);
}

int open_bytes(const void *bytes, size_t size, pendular_table *table)
{
    return pendular_table_view(bytes, size, table);
}

const char *text_of(const pendular_table *table, int channel, int which)
{
    return which == 0 ? pendular_table_name(table, channel)
        : which == 1  ? pendular_table_unit(table, channel)
                      : pendular_table_bound_of(table, channel);
}

double bound_of(const pendular_table *table, int channel)
{
    return table->channel[channel].bound;
}

int channel_of(const pendular_table *table, const char *name)
{
    return pendular_table_find_channel(table, name);
}

void moved_to(const pendular_table *table, const void *bytes, pendular_table *moved)
{
    *moved = pendular_table_moved(table, bytes);
}

void ask(const pendular_table *table, int asked, size_t count, const double *separation, const double *control,
    const double *radius1, const double *radius2, const double *surface_tension, double *out)
{
    size_t i;
    for (i = 0; i < count; ++i)
        out[i] = pendular_table_value(
            table, asked, separation[i], control[i], radius1[i], radius2[i], surface_tension[i]);
}

void ask_block(const pendular_table *table, int asked, size_t count, const double *separation, const double *control,
    const double *radius1, const double *radius2, double surface_tension, double *out)
{
    pendular_table_block(table, asked, count, separation, control, radius1, radius2, surface_tension, out);
}

/* The functions with a name of their own. */
double ask_by_name(const pendular_table *table, int asked, double separation, double control, double radius1,
    double radius2, double surface_tension)
{
    switch (asked) {
    case PENDULAR_TABLE_RUPTURE_DISTANCE:
        return pendular_table_rupture_distance(table, control, radius1, radius2, surface_tension);
    case PENDULAR_TABLE_FORCE:
        return pendular_table_force(table, separation, control, radius1, radius2, surface_tension);
    case PENDULAR_TABLE_LIQUID:
        return pendular_table_liquid(table, separation, control, radius1, radius2, surface_tension);
    case PENDULAR_TABLE_STIFFNESS:
        return pendular_table_stiffness(table, separation, control, radius1, radius2, surface_tension);
    default:
        return pendular_table_energy(table, separation, control, radius1, radius2, surface_tension);
    }
}

#ifndef PENDULAR_TABLE_NO_FILES

SHARED int open_path(const char *path, pendular_table *table);
SHARED void close_table(pendular_table *table);

int open_path(const char *path, pendular_table *table)
{
    return pendular_table_open(path, table);
}

void close_table(pendular_table *table)
{
    pendular_table_close(table);
}

#endif
