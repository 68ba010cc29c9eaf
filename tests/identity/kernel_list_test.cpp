// SPDX-License-Identifier: Apache-2.0
// Every row of the list of kernels, in every table: there, and of its own instruction set.
// in: the tables of this build -> out: pass or fail.
// docs/architecture.md, "Kernels: written once".
#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "kernels_cpu/isa/kernels.h"
#include "src/photons/trace.h"

using namespace pileus;

namespace {

/// A row of one table.
struct Row {
    std::string name;
    const void* kernel;
};

template <class Result, class... Arguments>
Row row_of(const char* name, Result (*kernel)(Arguments...)) {
    return {name, reinterpret_cast<const void*>(kernel)};
}

std::vector<Row> rows_of(const KernelTable& table) {
    return {
#define PILEUS_CALL(name, Result, parameters, names, group, where) row_of(#name, table.name),
#define PILEUS_RANGE(name, Params, Buffers, group, where) row_of(#name, table.name),
#include "kernels_cpu/isa/kernel_list.h"
    };
}

}  // namespace

TEST_CASE("kernel list: every row of every table is there, and of its own instruction set") {
    std::vector<std::string> tables;
    std::vector<std::vector<Row>> rows;
    for (int i = 0; const KernelTable* table = kernel_table_at(i); ++i) {
        tables.push_back(table->name);
        rows.push_back(rows_of(*table));
        CHECK(table->device == nullptr);
    }
    REQUIRE(!rows.empty());
    for (std::size_t t = 0; t < rows.size(); ++t) {
        CAPTURE(tables[t]);
        for (std::size_t r = 0; r < rows[t].size(); ++r) {
            CAPTURE(rows[t][r].name);
            REQUIRE(rows[t][r].kernel != nullptr);
            // No two rows share a function, within a table or across two.
            for (std::size_t other = 0; other <= t; ++other)
                for (std::size_t q = 0; q < (other < t ? rows[other].size() : r); ++q)
                    CHECK_MESSAGE(rows[other][q].kernel != rows[t][r].kernel, rows[other][q].name);
        }
    }
}

TEST_CASE("kernel list: every table gives the self test's value") {
    for (int i = 0; const KernelTable* table = kernel_table_at(i); ++i) {
        CAPTURE(table->name);
        CHECK(table->self_test() == expected_self_test());
    }
}

TEST_CASE("kernel list: a launch of photons takes the one trace that it needs") {
    const KernelTable& table = *kernel_table(nullptr);
    TraceParams k{};
    const auto takes = [&](TraceKernel kernel) { return trace_kernel(table, k) == kernel; };
    CHECK(takes(table.trace));
    k.solids.count = 1;
    CHECK(takes(table.trace_solids));
    k.cells[0] = 4;
    CHECK(takes(table.trace_cells));
    k.solids.count = 0;
    CHECK(takes(table.trace_cells));
}

TEST_CASE("kernel list: what a host makes for a device comes from the host's widest table") {
    const DeviceTable none{nullptr, nullptr};
    const KernelTable device{"device", 1, &none};
    CHECK(&host_kernels(&device) == kernel_table(nullptr));
    CHECK(&host_kernels(nullptr) == kernel_table(nullptr));
    for (int i = 0; const KernelTable* table = kernel_table_at(i); ++i)
        CHECK(&host_kernels(table) == table);
}
