/* Bridges of a table, as `pendular export table` writes it. SPDX-License-Identifier: BSD-3-Clause */
#include <cstdlib>
#include <cstring>
#include <vector>

#include "fmt/format.h"
#include "pendular_table.h"
#include "source.h"

namespace pendular_lammps {
namespace {

    class TableOfFile : public Source {
    public:
        TableOfFile(std::string path, void *memory, const pendular_table &table) :
            path(std::move(path)), memory(memory), table(table)
        {
        }
        ~TableOfFile() override { std::free(memory); }
        TableOfFile(const TableOfFile &) = delete;
        TableOfFile &operator=(const TableOfFile &) = delete;

        bool holds(int control) const override { return (control == PENDULAR_VOLUME) == (table.is_volume != 0); }
        bool is_of_two_angles() const override { return table.sides == 2; }

        double rupture(int, double held, const Solids &solids, double tension) const override
        {
            return find(held, solids, tension).rupture;
        }

        double pull(int, Bridge &bridge, const Solids &solids, double tension, double separation) const override
        {
            const pendular_table_place place = find(bridge.held, solids, tension);
            if (separation <= 0.0)
                return pendular_table_force_at(&table, &place, 0.0, tension);
            keep_cell(bridge, place, tension, separation);
            return pull_in_cell(bridge, separation);
        }

        double energy(int, double held, const Solids &solids, double tension, double separation) const override
        {
            const pendular_table_place place = find(held, solids, tension);
            return pendular_table_energy_at(&table, &place, separation, tension);
        }

        double liquid(int, double held, const Solids &solids, double tension, double separation) const override
        {
            return pendular_table_liquid(&table, separation, held, solids.radius1, solids.radius2, tension);
        }

        std::string refusal(int, double held, const Solids &solids, double tension) const override
        {
            const double small = std::fmin(solids.radius1, solids.radius2);
            const double large = std::fmax(solids.radius1, solids.radius2);
            const double mean = 2.0 * small / (1.0 + small / large);
            const double reduced = table.is_volume ? held / (mean * mean * mean) : held / tension * mean;
            if (!(small / large >= table.least_ratio && small / large <= table.largest_ratio))
                return fmt::format("radius ratio {:.6g} is not in [{:.6g}, {:.6g}], the range of {}", large / small,
                    table.radius_ratio[0], table.radius_ratio[1], path);
            return fmt::format("reduced {} {:.6g} is not in [{:.6g}, {:.6g}], the range of {}",
                table.is_volume ? "volume" : "suction", reduced, table.reduced[0], table.reduced[1], path);
        }

    private:
        std::string path;
        void *memory;
        pendular_table table;

        pendular_table_place find(double held, const Solids &solids, double tension) const
        {
            return pendular_table_find(&table, held, solids.radius1, solids.radius2, tension);
        }

        void keep_cell(Bridge &bridge, const pendular_table_place &place, double tension, double separation) const
        {
            const double *line = table.lines + static_cast<int64_t>(place.row) * PENDULAR_TABLE_LINE;
            const int32_t *cut = table.cuts + static_cast<int64_t>(place.row) * PENDULAR_TABLE_CUT;
            double w;
            const int32_t cell
                = pendular_table_q_cell(&table, place.row, pendular_table_q(&place, separation), &w);
            const int32_t shift = cut[PENDULAR_TABLE_Q_SHIFT], first = cut[PENDULAR_TABLE_Q_FIRST];
            const double low = pendular_table_edge(cell, shift, first);
            const double scale = 2.0 / (pendular_table_edge(cell + 1, shift, first) - low);
            const double unit = pendular_table_unit_of(&table, place.row, PENDULAR_TABLE_FORCE)
                * pendular_table_scale(&table.channel[PENDULAR_TABLE_FORCE], place.control, place.radius, tension);
            pendular_table_lanes_of(&table, PENDULAR_TABLE_FORCE, &place, cell, bridge.series);
            for (double &coefficient : bridge.series)
                coefficient *= unit;
            bridge.offset = scale * (line[PENDULAR_TABLE_Q0] - low) - 1.0;
            bridge.slope = scale * line[PENDULAR_TABLE_Q1];
            bridge.bend = place.bend;
        }
    };

    /* Bytes of a file on all ranks, aligned as tables like it; empty where it cannot be read. */
    void *shared_bytes(const std::string &path, MPI_Comm world, long long &size)
    {
        int me;
        MPI_Comm_rank(world, &me);
        FILE *file = me == 0 ? std::fopen(path.c_str(), "rb") : nullptr;
        size = -1;
        if (file && std::fseek(file, 0, SEEK_END) == 0)
            size = std::ftell(file);
        MPI_Bcast(&size, 1, MPI_LONG_LONG, 0, world);
        void *bytes = size >= 0 ? std::aligned_alloc(64, (static_cast<size_t>(size) / 64 + 1) * 64) : nullptr;
        int is_read = 1;
        if (file) {
            std::rewind(file);
            is_read = bytes && std::fread(bytes, 1, size, file) == static_cast<size_t>(size);
            std::fclose(file);
        }
        int is_whole = bytes && is_read;
        MPI_Allreduce(MPI_IN_PLACE, &is_whole, 1, MPI_INT, MPI_MIN, world);
        if (!is_whole) {
            std::free(bytes);
            return nullptr;
        }
        const long long part = 1LL << 30;
        for (long long begin = 0; begin < size; begin += part)
            MPI_Bcast(static_cast<char *>(bytes) + begin, static_cast<int>(std::min(part, size - begin)), MPI_BYTE, 0,
                world);
        return bytes;
    }
}    // namespace

std::shared_ptr<const Source> table_of_file(const std::string &path, MPI_Comm world, std::string &reason)
{
    long long size;
    void *bytes = shared_bytes(path, world, size);
    pendular_table table;
    const int code
        = bytes ? pendular_table_view(bytes, size, &table) : static_cast<int>(PENDULAR_TABLE_UNREADABLE);
    if (code != PENDULAR_TABLE_OK) {
        std::free(bytes);
        reason = pendular_table_error(code);
        return nullptr;
    }
    return std::make_shared<TableOfFile>(path, bytes, table);
}

}    // namespace pendular_lammps
