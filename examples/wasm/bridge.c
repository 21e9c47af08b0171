/* Bridges for JavaScript: a table is given as bytes, and asked for one contact at a time.

   pendular export table --contact-angle 20 --out w.bridges --header pendular_table.h
   clang --target=wasm32-wasi -mexec-model=reactor -O2 -o bridge.wasm bridge.c
   node bridge.mjs bridge.wasm w.bridges
*/
#define PENDULAR_TABLE_NO_FILES
#include "pendular_table.h"

#include <stdlib.h>

#define EXPORTED(name) __attribute__((export_name(#name))) name

static pendular_table table;

/* Where the bytes of a table are to be put: at a multiple of 64. */
void *EXPORTED(room)(size_t size)
{
    return aligned_alloc(64, (size + 63) / 64 * 64);
}

/* A text that is empty if the table is open, else a reason why not. */
const char *EXPORTED(open_table)(const void *bytes, size_t size)
{
    const int code = pendular_table_view(bytes, size, &table);
    return code == PENDULAR_TABLE_OK ? "" : pendular_table_error(code);
}

double EXPORTED(force)(double separation, double control, double radius1, double radius2, double surface_tension)
{
    return pendular_table_force(&table, separation, control, radius1, radius2, surface_tension);
}

double EXPORTED(rupture_distance)(double control, double radius1, double radius2, double surface_tension)
{
    return pendular_table_rupture_distance(&table, control, radius1, radius2, surface_tension);
}
