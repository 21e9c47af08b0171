/* Bridges, as they are kept from step to step. SPDX-License-Identifier: BSD-3-Clause */
#include "bridge.h"

#include <iterator>

namespace pendular_lammps {

void Bridges::clear()
{
    ends.clear();
    record.clear();
    origin.clear();
    records.clear();
    unused.clear();
}

/* New memory is slow to come by, and a bridge that is moved into more of it takes it twice. */
void Bridges::reserve(int most)
{
    ends.reserve(most);
    record.reserve(most);
    origin.reserve(most);
}

Bridge &Bridges::record_of(int number)
{
    int &own = record[number];
    if (own < 0 && unused.empty()) {
        own = static_cast<int>(records.size());
        records.emplace_back();
    } else if (own < 0) {
        own = unused.back();
        unused.pop_back();
    }
    return records[own];
}

void Bridges::drop_record(int number)
{
    if (record[number] < 0)
        return;
    records[record[number]] = Bridge();
    unused.push_back(record[number]);
    record[number] = -1;
}

void Bridges::remove(int number)
{
    drop_record(number);
    ends[number] = ends.back();
    record[number] = record.back();
    origin[number] = origin.back();
    ends.pop_back();
    record.pop_back();
    origin.pop_back();
}

void Bridges::append(Bridges &other)
{
    const int before = static_cast<int>(records.size());
    for (int number : other.unused)
        unused.push_back(before + number);
    for (int number : other.record)
        record.push_back(number < 0 ? -1 : before + number);
    ends.insert(ends.end(), other.ends.begin(), other.ends.end());
    origin.insert(origin.end(), other.origin.begin(), other.origin.end());
    records.insert(records.end(), std::make_move_iterator(other.records.begin()),
        std::make_move_iterator(other.records.end()));
    other.clear();
}

double Bridges::bytes() const
{
    return static_cast<double>(ends.capacity()) * (sizeof(Ends) + sizeof(int) + sizeof(Origin))
        + static_cast<double>(records.capacity()) * sizeof(Bridge);
}

}    // namespace pendular_lammps
