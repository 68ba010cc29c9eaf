// SPDX-License-Identifier: Apache-2.0
// Arguments of calls out of arbitrary bytes: those that hosts give, and those that none should.
// in: bytes -> out: numbers, counts, structs of any age.
// tests/fuzz/calls.cpp
#pragma once
#include <cstddef>
#include <cstdint>
#include <iterator>

namespace fuzz {

class Arguments {
public:
    Arguments(const std::uint8_t* data, std::size_t size) : data_(data), left_(size) {}
    bool done() const { return left_ == 0; }

    std::uint8_t byte() {
        if (left_ == 0) return 0;
        --left_;
        return *data_++;
    }

    /// Numbers that hosts set, and those that none should.
    double number() {
        constexpr double kSpecial[] = {
            0, __builtin_nan(""), __builtin_inf(), -1e300, 1e-310, 90, -180, 360};
        const std::uint8_t how = byte();
        if (how < std::size(kSpecial)) return kSpecial[how];
        return (double(how) - 128) * (byte() % 2 == 0 ? 0.25 : 25.0);
    }
    float single() {
        const double v = number();
        return v > 3e38 || v < -3e38 ? __builtin_inff() : float(v);
    }
    /// 0, small, or as large as it goes.
    std::uint32_t count() {
        const std::uint8_t how = byte();
        if (how == 255) return 0xffffffffu;
        if (how == 254) return 0x80000000u;
        return how % 5;
    }
    template <std::size_t N>
    void numbers(double (&to)[N]) {
        for (double& v : to) v = number();
    }
    template <std::size_t N>
    void singles(float (&to)[N]) {
        for (float& v : to) v = single();
    }
    /// Marks a struct as one of now, of another size, or not at all; null now and then.
    template <class T>
    T* aged(T& given) {
        switch (byte()) {
            case 0:
                return nullptr;
            case 1:
                given.struct_size = 0;
                break;
            case 2:
                given.struct_size = std::uint32_t(sizeof given);
                break;
            case 3:  // an older library's
                given.struct_size =
                    (given.struct_size & 0xffff0000u) | std::uint32_t(sizeof given / 2);
                break;
            default:
                break;
        }
        return &given;
    }

private:
    const std::uint8_t* data_;
    std::size_t left_;
};

}  // namespace fuzz
