// SPDX-License-Identifier: Apache-2.0
// See threads.h.
#include "platform/threads.h"

namespace pileus {
namespace {

Host with_pool(ThreadPool& pool) {
    Host host = current_host();
    if (host.executor == nullptr && host.pool == nullptr) host.pool = &pool;
    return host;
}

}  // namespace

ThreadPool::~ThreadPool() { end_team(team_); }

void ThreadPool::run(std::uint32_t count, TeamBody body, void* data) {
    run_team(team_, count, body, data);
}

const char* ThreadPool::name() const { return team_name(team_); }

PoolGuard::PoolGuard(ThreadPool& pool) : lent_(with_pool(pool)) {}

const char* threads_name() {
    const Host& host = current_host();
    if (host.executor != nullptr) return "the host's";
    return host.pool != nullptr ? host.pool->name() : team_name(nullptr);
}

}  // namespace pileus
