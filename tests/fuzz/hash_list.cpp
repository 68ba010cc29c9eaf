// SPDX-License-Identifier: Apache-2.0
// Fuzz target: lists of hashes that pictures should have, and those of an option.
// in: the text of a list -> out: hashes with names, each once, or lines with their places.
// docs/program.md, "hash"
#include "tools/pileus/hash_list.h"

#include <set>

#include "tests/fuzz/target.h"

namespace {

void check_hash(const std::string& hash) {
    fuzz::require(hash.size() == 16, "a hash has 16 digits");
    for (const char c : hash)
        fuzz::require((c >= '0' && c <= '9') || (c >= 'a' && c <= 'f'), "in lower case");
}

}  // namespace

int fuzz::hash_list(const std::uint8_t* data, std::size_t size) {
    using namespace pileus;
    const std::string text(reinterpret_cast<const char*>(data), size);
    std::vector<std::string> hashes;
    const Status frames = read_frame_hashes(text, hashes);
    if (frames)
        for (const std::string& hash : hashes) check_hash(hash);
    else
        fuzz::check_fault(frames, "--expect-hash: ", true);
    std::vector<ListedHash> list;
    const Status status = parse_hash_list("list", text, list);
    if (!status) {
        fuzz::check_fault(status, "list:", false);
        return 0;
    }
    fuzz::require(!list.empty(), "a list has hashes");
    std::set<std::string> names;
    int line = 0;
    for (const ListedHash& entry : list) {
        check_hash(entry.hash);
        fuzz::require(entry.line > line, "lines count on");
        line = entry.line;
        fuzz::require(!entry.file.empty() || list.size() == 1, "each of several has a name");
        fuzz::require(names.insert(entry.file).second, "each name comes once");
        fuzz::require(same_name(entry.file, entry.file), "a name is itself");
    }
    // What was read, written again, is read as it was.
    std::string again;
    for (const ListedHash& entry : list)
        again += entry.hash + (entry.file.empty() ? "" : "  " + entry.file) + "\n";
    std::vector<ListedHash> same;
    fuzz::require(bool(parse_hash_list("list", again, same)), "it can be written");
    for (std::size_t i = 0; i < list.size(); ++i)
        fuzz::require(same[i].hash == list[i].hash && same[i].file == list[i].file,
                      "and is the same list");
    return 0;
}
