// SPDX-License-Identifier: Apache-2.0
// See c_types.h. Versions, errors, what a host lends.
#include <glm/gtc/type_ptr.hpp>

#include "src/api/c_types.h"
#include "src/world/camera/view.h"

namespace pileus::api {

Status no_struct(const char* name) {
    return Status::bad_input(
        std::string(name) + ": null or not initialised, allowed: what its pileus_*_default() made");
}

Status no_element(const char* name, std::size_t i) {
    return Status::bad_input(std::string(name) + "[" + std::to_string(i) +
                             "]: not initialised, or of another size than the first one, "
                             "allowed: what its pileus_*_default() made");
}

pileus_code no_session(pileus_error* error) {
    return finish(Code::kBadInput, "session: null, allowed: what a function of pileus made", error);
}

Status no_handle(const char* name) {
    return Status::bad_input(std::string(name) + ": null, allowed: what a function of pileus made");
}

pileus_code finish(Code status, std::string_view text, pileus_error* error) {
    const pileus_code code = static_cast<pileus_code>(status);
    const std::size_t given = error == nullptr ? 0 : marked_size(error->struct_size);
    if (given < 2 * sizeof(std::uint32_t)) return code;
    error->code = code;
    const std::size_t head = offsetof(pileus_error, message);
    if (given <= head) return code;
    std::size_t room = given - head;
    if (room > sizeof error->message) room = sizeof error->message;
    copy_cut(text, error->message, room);
    return code;
}

void copy_cut(std::string_view text, char* to, std::size_t room) {
    const std::size_t size = text.size() < room ? text.size() : room - 1;
    std::memcpy(to, text.data(), size);
    to[size] = 0;
    if (size < text.size() && size >= 3) std::memcpy(to + size - 3, "...", 3);
}

pileus_code settle(const HostParts& host, pileus_code code, pileus_error* error) {
    if (host.block->is_clear()) return code;
    return finish(Code::kCheckFailed, "flight: a call kept memory, a fault of the library", error);
}

pileus_code broken_off(const HostParts& host, pileus_error* error) {
    host.block->set_way_out(nullptr);
    host.block->break_off();
    return finish(Code::kLimit,
                  "flight.block: no room for small objects in a call, allowed: a session opened "
                  "anew in a larger block",
                  error);
}

Status give_text(const std::string& own, const char* name, char* text, std::size_t size,
                 std::size_t* needed) {
    if (needed != nullptr) *needed = own.size() + 1;
    if (text == nullptr && size == 0) return Status::ok();
    if (text == nullptr) return Status::bad_input("text: null, allowed: of size bytes");
    if (size < own.size() + 1)
        return Status::limit(std::string(name) + ": needs " + std::to_string(own.size() + 1) +
                             " bytes, allowed: " + std::to_string(size));
    std::memcpy(text, own.c_str(), own.size() + 1);
    return Status::ok();
}

Status take_host(const pileus_host* given, std::shared_ptr<const HostParts>& host,
                 RenderOptions& options) {
    const auto parts = std::make_shared<HostParts>();
    if (given != nullptr && !take(given, parts->given)) return no_struct("host");
    const pileus_host& h = parts->given;
    if ((h.allocate == nullptr) != (h.release == nullptr))
        return Status::bad_input("host: allocate and release, one is null, allowed: both or none");
    if (h.threads > kMaxThreads)
        return Status::bad_input("host.threads: " + std::to_string(h.threads) +
                                 ", allowed: 0 (all) to " + std::to_string(kMaxThreads));
    parts->allocator = {h.allocate, h.release, h.user};
    parts->executor = {h.run, h.user};
    options.threads = int(h.threads);
    if (h.isa != nullptr) options.isa = h.isa;
    options.layers = h.layers != 0;
    if (h.memory_limit > 0) options.limits[LimitId::kMemory] = h.memory_limit;
    const HostParts* kept = parts.get();
    if (h.progress != nullptr)
        options.progress = [kept](const char* stage, double share) {
            kept->given.progress(kept->given.user, stage, share);
        };
    if (h.stop != nullptr)
        options.interrupted = [kept] { return kept->given.stop(kept->given.user) != 0; };
    host = parts;
    return Status::ok();
}

}  // namespace pileus::api

extern "C" {

void pileus_init(void* pileus_struct, uint32_t size) {
    if (!pileus::api::is_room(pileus_struct, size)) return;
    const uint32_t marked = pileus::api::kStructMark | size;
    std::memset(pileus_struct, 0, size);
    std::memcpy(pileus_struct, &marked, sizeof marked);
}

const char* pileus_version(void) { return pileus::kVersion; }

uint32_t pileus_api_version(void) { return PILEUS_API_VERSION; }

void pileus_orbit(const double position_m[3], const double target_m[3], double degrees,
                  double turned_m[3]) {
    if (position_m == nullptr || target_m == nullptr || turned_m == nullptr) return;
    const pileus::FpModeGuard mode;
    const pileus::Double3 turned =
        pileus::orbit(glm::make_vec3(position_m), glm::make_vec3(target_m), degrees);
    for (int a = 0; a < 3; ++a) turned_m[a] = turned[a];
}

}  // extern "C"
