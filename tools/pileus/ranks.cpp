// SPDX-License-Identifier: Apache-2.0
// See ranks.h. The only file that touches MPI. Messages are cut to pieces that its counts hold.
// MPI 3.1
#include "tools/pileus/ranks.h"

#ifdef PILEUS_WITH_MPI
#include <mpi.h>
#include <time.h>

#include <cstdlib>
#include <cstring>
#endif

namespace pileus {

#ifdef PILEUS_WITH_MPI
namespace {

constexpr std::uint64_t kPiece = std::uint64_t{1} << 27;
constexpr int kBytesTag = 1;

bool begun = false;

/// A program that no launcher has started takes no part in MPI, whose start takes time.
bool is_launched() {
    for (const char* name : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "PMI_RANK", "PMIX_RANK"})
        if (std::getenv(name) != nullptr) return true;
    return false;
}

Ranks begin_ranks() {
    Ranks out;
    if (!is_launched()) return out;
    int provided = 0;
    MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &provided);
    begun = true;
    MPI_Comm_rank(MPI_COMM_WORLD, &out.rank);
    MPI_Comm_size(MPI_COMM_WORLD, &out.count);
    MPI_Comm machine;
    MPI_Comm_split_type(MPI_COMM_WORLD, MPI_COMM_TYPE_SHARED, out.rank, MPI_INFO_NULL, &machine);
    MPI_Comm_size(machine, &out.beside);
    MPI_Comm_free(&machine);
    return out;
}

/// Until all ranks are here. Ranks that MPI lets wait keep their processors busy; these sleep.
void meet() {
    MPI_Request request;
    MPI_Ibarrier(MPI_COMM_WORLD, &request);
    for (int done = 0;;) {
        MPI_Test(&request, &done, MPI_STATUS_IGNORE);
        if (done != 0) return;
        const timespec nap{0, 1000000};
        nanosleep(&nap, nullptr);
    }
}

/// Calls function(first, count) for pieces of `size` things.
template <class Function>
void in_pieces(std::uint64_t size, Function function) {
    for (std::uint64_t at = 0; at < size; at += kPiece)
        function(at, int(size - at < kPiece ? size - at : kPiece));
}

/// Each rank is a part.
class RankShare final : public WorkShare {
public:
    WorkPart part() const override {
        return {std::uint32_t(ranks().rank), std::uint32_t(ranks().count), true};
    }
    Status sum(Span<std::int64_t> values) override {
        meet();
        in_pieces(values.size, [&](std::uint64_t at, int count) {
            MPI_Allreduce(MPI_IN_PLACE, values.data + at, count, MPI_INT64_T, MPI_SUM,
                          MPI_COMM_WORLD);
        });
        return Status::ok();
    }
    Status gather(Span<double> values, std::uint64_t width) override {
        meet();
        for (std::uint32_t r = 0; r < part().count; ++r)
            each_owned_run(values.size, width, {r, part().count, true}, [&](const PartRange& own) {
                in_pieces(own.end - own.begin, [&](std::uint64_t at, int count) {
                    MPI_Bcast(values.data + own.begin + at, count, MPI_DOUBLE, int(r),
                              MPI_COMM_WORLD);
                });
            });
        return Status::ok();
    }
    bool all_ready(bool own) override {
        meet();
        int ready = own ? 1 : 0;
        MPI_Allreduce(MPI_IN_PLACE, &ready, 1, MPI_INT, MPI_MIN, MPI_COMM_WORLD);
        return ready != 0;
    }
    Status decide(std::uint64_t& value) override {
        meet();
        MPI_Bcast(&value, 1, MPI_UINT64_T, 0, MPI_COMM_WORLD);
        return Status::ok();
    }
};

}  // namespace

bool has_mpi() { return true; }

const Ranks& ranks() {
    static const Ranks all = begin_ranks();
    return all;
}

int end_ranks(int status) {
    if (!begun) return status;
    MPI_Finalize();
    begun = false;
    return ranks().is_first() ? status : 0;
}

Status agree(const Status& own) {
    const Ranks& r = ranks();
    if (r.count == 1) return own;
    meet();
    // A line without a fault, such as that of an interrupted run, is no reason to end.
    int mine[2] = {int(own.code), own.code == Code::kOk ? r.count : r.rank};
    int worst = 0, first = 0;
    MPI_Allreduce(&mine[1], &first, 1, MPI_INT, MPI_MIN, MPI_COMM_WORLD);
    if (first == r.count) return own;
    worst = mine[0];
    MPI_Bcast(&worst, 1, MPI_INT, first, MPI_COMM_WORLD);
    Status out{Code(worst), ""};
    std::uint64_t size = own.message.size();
    MPI_Bcast(&size, 1, MPI_UINT64_T, first, MPI_COMM_WORLD);
    out.message = r.rank == first ? own.message : std::string(std::size_t(size), ' ');
    MPI_Bcast(out.message.data(), int(size), MPI_CHAR, first, MPI_COMM_WORLD);
    if (!r.is_first()) out.message.clear();
    return out;
}

Status sum_to_first(Span<std::int64_t> values) {
    const Ranks& r = ranks();
    if (r.count == 1) return Status::ok();
    in_pieces(values.size, [&](std::uint64_t at, int count) {
        std::int64_t* own = values.data + at;
        MPI_Reduce(r.is_first() ? MPI_IN_PLACE : own, own, count, MPI_INT64_T, MPI_SUM, 0,
                   MPI_COMM_WORLD);
    });
    return Status::ok();
}

void send_from_first(Span<char> bytes) {
    if (ranks().count == 1) return;
    meet();
    in_pieces(bytes.size, [&](std::uint64_t at, int count) {
        MPI_Bcast(bytes.data + at, count, MPI_CHAR, 0, MPI_COMM_WORLD);
    });
}

Status gather_to_first(Span<const char> own, std::vector<Buffer<char>>& all) {
    const Ranks& r = ranks();
    std::uint64_t size = own.size;
    if (!r.is_first()) {
        MPI_Send(&size, 1, MPI_UINT64_T, 0, kBytesTag, MPI_COMM_WORLD);
        in_pieces(size, [&](std::uint64_t at, int count) {
            MPI_Send(own.data + at, count, MPI_CHAR, 0, kBytesTag, MPI_COMM_WORLD);
        });
        return Status::ok();
    }
    all.clear();
    all.resize(std::size_t(r.count));
    PILEUS_TRY(all[0].resize(size, "light of a rank"));
    if (size > 0) std::memcpy(all[0].data(), own.data, std::size_t(size));
    Status room;
    for (int from = 1; from < r.count; ++from) {
        MPI_Recv(&size, 1, MPI_UINT64_T, from, kBytesTag, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
        Buffer<char>& bytes = all[std::size_t(from)];
        const Status here = bytes.resize(size, "light of a rank");
        // What there is no room for is still received, or its sender would wait for ever.
        if (!here) room = here;
        Buffer<char> waste;
        if (!here && !waste.resize(size < kPiece ? size : kPiece, "light of a rank"))
            MPI_Abort(MPI_COMM_WORLD, int(Code::kLimit));
        in_pieces(size, [&](std::uint64_t at, int count) {
            MPI_Recv(here ? bytes.data() + at : waste.data(), count, MPI_CHAR, from, kBytesTag,
                     MPI_COMM_WORLD, MPI_STATUS_IGNORE);
        });
    }
    return room;
}

WorkShare* rank_share() {
    static RankShare share;
    return ranks().count > 1 ? &share : nullptr;
}
#else
bool has_mpi() { return false; }

const Ranks& ranks() {
    static const Ranks alone;
    return alone;
}

int end_ranks(int status) { return status; }

Status agree(const Status& own) { return own; }
Status sum_to_first(Span<std::int64_t>) { return Status::ok(); }
void send_from_first(Span<char>) {}

Status gather_to_first(Span<const char> own, std::vector<Buffer<char>>& all) {
    all.clear();
    all.resize(1);
    PILEUS_TRY(all[0].resize(own.size, "light"));
    for (std::size_t i = 0; i < own.size; ++i) all[0][i] = own.data[i];
    return Status::ok();
}

WorkShare* rank_share() { return nullptr; }
#endif

}  // namespace pileus
