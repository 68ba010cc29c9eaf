// SPDX-License-Identifier: Apache-2.0
// Plain structs as bytes and back, the same bytes on every machine.
// in: structs whose members `fields` names (fields_scene.h, fields_world.h) -> out: little-endian
// bytes; in: bytes that nobody has checked -> out: the same structs, or a fault.
// docs/flight.md, "Packed scenes"
#pragma once
#include <array>
#include <cstring>
#include <map>
#include <string>
#include <type_traits>
#include <vector>

#include "src/base/buffer.h"
#include "src/base/vectors.h"

namespace pileus {

/// Whether numbers lie in this machine's memory as in an archive.
#if __BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__
constexpr bool kLittleEndian = true;
#else
constexpr bool kLittleEndian = false;
#endif

/// Arrays of floats begin and end at multiples of it, counted from the first byte.
constexpr std::size_t kLine = 64;

/// Appends values to bytes.
class ArchiveWriter {
public:
    static constexpr bool kReads = false;
    std::string bytes;

    bool good() const { return true; }
    void word(std::uint64_t& v, int size) {
        for (int i = 0; i < size; ++i) bytes += char(v >> (8 * i) & 0xff);
    }
    template <class T>
    void count(const T& list, std::uint64_t) {
        std::uint64_t n = list.size();
        word(n, 8);
    }
    /// An array of floats, so that it can be read where it lies.
    template <class T>
    void array(Buffer<T>& list) {
        count(list, sizeof(T));
        if (list.empty()) return;
        fill_up();
        for (T& v : list.span()) field(*this, v);
        fill_up();
    }

private:
    void fill_up() { bytes.resize((bytes.size() + kLine - 1) / kLine * kLine); }
};

/// Takes values from bytes; past their end, and where a value cannot be, it gives zeros and says
/// so.
class ArchiveReader {
public:
    static constexpr bool kReads = true;
    /// `in_place`: arrays are read where they lie, so the bytes must stay, and begin at a multiple
    /// of kLine.
    ArchiveReader(const char* bytes, std::size_t size, bool in_place = false)
        : at_(bytes), left_(size), all_(size), in_place_(in_place) {}

    bool good() const { return !broken_; }
    bool is_done() const { return good() && left_ == 0; }
    bool out_of_memory() const { return no_memory_; }
    void fail() { broken_ = true; }
    void word(std::uint64_t& v, int size) {
        v = 0;
        if (broken_ || left_ < std::size_t(size)) return fail();
        for (int i = 0; i < size; ++i) v |= std::uint64_t(std::uint8_t(at_[i])) << (8 * i);
        at_ += size;
        left_ -= std::size_t(size);
    }
    /// Sizes a list, whose members take a byte or more each.
    template <class T>
    void count(T& list, std::uint64_t most) {
        std::uint64_t n = 0;
        word(n, 8);
        if (n > left_ || n > most) return fail();
        list.resize(std::size_t(n));
    }
    template <class T>
    void count(Buffer<T>& list, std::uint64_t bytes_each) {
        std::uint64_t n = 0;
        word(n, 8);
        if (n > left_ / bytes_each) return fail();
        if (!list.resize(n, "packed array")) {
            no_memory_ = true;
            fail();
        }
    }
    /// An array of floats.
    template <class T>
    void array(Buffer<T>& list) {
        std::uint64_t n = 0;
        word(n, 8);
        if (n == 0) return;
        fill_up();
        if (n > left_ / sizeof(T)) return fail();
        if (in_place_ && kLittleEndian) {
            list.lend(reinterpret_cast<const T*>(at_), std::size_t(n));
            at_ += list.bytes(), left_ -= std::size_t(list.bytes());
        } else if (list.resize(n, "packed array")) {
            for (std::size_t i = 0; i < n && good(); ++i) field(*this, list[i]);
        } else {
            no_memory_ = true;
            return fail();
        }
        fill_up();
    }

private:
    void fill_up() {
        const std::size_t past = (all_ - left_) % kLine, gap = past == 0 ? 0 : kLine - past;
        if (broken_ || gap > left_) return fail();
        at_ += gap;
        left_ -= gap;
    }
    const char* at_;
    std::size_t left_, all_;
    bool in_place_, broken_ = false, no_memory_ = false;
};

template <class A>
void field(A& a, bool& v) {
    std::uint64_t word = v ? 1 : 0;
    a.word(word, 1);
    if constexpr (A::kReads) {
        if (word > 1) a.fail();
        v = word == 1;
    }
}

template <class A, class T>
std::enable_if_t<std::is_integral_v<T> && !std::is_same_v<T, bool>> field(A& a, T& v) {
    // Whole numbers have eight bytes: what they are wide differs among machines.
    auto word = std::uint64_t(std::int64_t(v));
    a.word(word, 8);
    if constexpr (A::kReads) {
        v = T(word);
        if (std::uint64_t(std::int64_t(v)) != word) a.fail();
    }
}

template <class A, class T>
std::enable_if_t<std::is_floating_point_v<T>> field(A& a, T& v) {
    std::conditional_t<sizeof(T) == 4, std::uint32_t, std::uint64_t> bits;
    static_assert(sizeof bits == sizeof v, "floats and doubles alone");
    std::memcpy(&bits, &v, sizeof v);
    std::uint64_t word = bits;
    a.word(word, sizeof v);
    if constexpr (A::kReads) {
        bits = decltype(bits)(word);
        std::memcpy(&v, &bits, sizeof v);
    }
}

/// Enumerations of the library have fewer than 16 values each, from 0 on.
template <class A, class T>
std::enable_if_t<std::is_enum_v<T>> field(A& a, T& v) {
    auto word = std::uint64_t(v);
    a.word(word, 1);
    if constexpr (A::kReads) {
        if (word > 15) return a.fail();
        v = T(word);
    }
}

/// Texts and lists of structs stay within what a scene may have.
constexpr std::uint64_t kMaxText = 1u << 16, kMaxRows = 4096;

template <class A>
void field(A& a, std::string& v) {
    a.count(v, kMaxText);
    for (std::size_t i = 0; i < v.size() && a.good(); ++i) {
        std::uint64_t word = std::uint8_t(v[i]);
        a.word(word, 1);
        if constexpr (A::kReads) v[i] = char(word);
    }
}

template <class A>
void field(A& a, Double3& v) {
    for (int i = 0; i < 3; ++i) field(a, v[i]);
}

template <class A, class T, std::size_t N>
void field(A& a, std::array<T, N>& v) {
    for (T& one : v) field(a, one);
}

template <class A, class T, std::size_t N>
void field(A& a, T (&v)[N]) {
    for (T& one : v) field(a, one);
}

/// Members of structs that are not yet declared here are found where this is used.
template <class A, class T>
void field(A& a, std::vector<T>& v) {
    a.count(v, kMaxRows);
    for (std::size_t i = 0; i < v.size() && a.good(); ++i) field(a, v[i]);
}

template <class A, class T>
void field(A& a, Buffer<T>& v) {
    if constexpr (std::is_floating_point_v<T>) return a.array(v);
    a.count(v, sizeof(T) < 8 ? sizeof(T) : 8);
    for (std::size_t i = 0; i < v.size() && a.good(); ++i) field(a, v[i]);
}

template <class A>
void field(A& a, std::map<std::string, double>& v) {
    std::vector<std::string> names;
    if constexpr (!A::kReads)
        for (const auto& one : v) names.push_back(one.first);
    field(a, names);
    for (const std::string& name : names) {
        if (!a.good()) return;
        field(a, v[name]);
    }
}

/// Structs: `template <class A> void fields(A&, T&)`, which names every member.
template <class A, class T>
std::enable_if_t<std::is_class_v<T>> field(A& a, T& v) {
    fields(a, v);
}

template <class A, class... Members>
void all(A& a, Members&... members) {
    (field(a, members), ...);
}

}  // namespace pileus
