// SPDX-License-Identifier: Apache-2.0
// The team of our own programs, which begin anew where OpenMP would spin otherwise.
// in: PILEUS_TEAM, how the program was started -> out: see teams.h.
// docs/performance.md, "Waiting"; docs/program.md, "Threads"
#include <unistd.h>

#include <cstdlib>
#include <string>

#include "platform/process.h"
#include "platform/team/teams.h"
#if PILEUS_WITH_OPENMP
#include <link.h>
#include <sys/auxv.h>
#endif

namespace pileus {
namespace {

constexpr const char* kAllowedTeams = PILEUS_WITH_OPENMP    ? "openmp, own, serial"
                                      : PILEUS_WITH_THREADS ? "own, serial"
                                                            : "serial";

TeamChoice taken(TeamKind kind) { return {kind, nullptr, kAllowedTeams}; }
TeamChoice refused(const char* why) { return {TeamKind::kSerial, why, kAllowedTeams}; }

#if PILEUS_WITH_OPENMP
/// Whether a loader was started by hand, with the program as its argument: what would begin anew
/// is the loader.
bool is_loaded_by_hand() {
    const auto needs_loader = [](dl_phdr_info* program, std::size_t, void*) {
        for (int i = 0; i < int(program->dlpi_phnum); ++i)
            if (program->dlpi_phdr[i].p_type == PT_INTERP) return 1;
        return 2;  // the first is the program; the others do not matter
    };
    return ::getauxval(AT_BASE) == 0 && ::dl_iterate_phdr(needs_loader, nullptr) == 1;
}

/// Returns where it cannot be done, or has been done already.
void begin_anew(char** words) {
    const char* policy = std::getenv("OMP_WAIT_POLICY");
    const char* spins = std::getenv("GOMP_SPINCOUNT");
    const bool done = policy != nullptr && spins != nullptr && std::string(policy) == "passive" &&
                      std::string(spins) == "0";
    if (done || is_loaded_by_hand()) return;
    const std::string program = own_program("");
    if (program.empty() || ::setenv("OMP_WAIT_POLICY", "passive", 1) != 0 ||
        ::setenv("GOMP_SPINCOUNT", "0", 1) != 0)
        return;
    // By its name, which then is the process's too; /proc/self/exe would be called "exe".
    (void)::execv(program.c_str(), words);
}

TeamChoice start_openmp(char** words, bool asked) {
    // A binding of OpenMP's threads is of no use to ours, and would hold them all on one processor.
    if (std::getenv("OMP_PROC_BIND") != nullptr || std::getenv("OMP_PLACES") != nullptr ||
        std::getenv("GOMP_CPU_AFFINITY") != nullptr) {
        unbind_from_openmp();
        for (const char* binding : {"OMP_PROC_BIND", "OMP_PLACES", "GOMP_CPU_AFFINITY"})
            (void)::unsetenv(binding);
    }
    if (openmp_can_be_told() || openmp_is_passive()) return taken(TeamKind::kOpenMp);
    begin_anew(words);
    if (asked) return refused("cannot be had here");
    return taken(TeamKind::kOwn);
}
#endif

}  // namespace

TeamChoice start_team(char** words) {
    const char* text = std::getenv(kTeamVariable);
    const std::string name = text != nullptr ? text : "";
    (void)words;
    if (name == "serial") return taken(TeamKind::kSerial);
#if PILEUS_WITH_OPENMP
    if (name.empty() || name == "openmp") return start_openmp(words, !name.empty());
#endif
#if PILEUS_WITH_THREADS
    if (name == "own") return taken(TeamKind::kOwn);
#endif
    if (name.empty()) return taken(TeamKind::kAllowed);
    if (name == "openmp" || name == "own") return refused("not in this build");
    return refused("unknown");
}

}  // namespace pileus
