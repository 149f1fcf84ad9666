// SPDX-License-Identifier: Apache-2.0
// Numbers as a person or a script gives them to a command: in the classic locale, separated by blanks or commas.
#pragma once

#include <charconv>
#include <span>
#include <string_view>

namespace iride {

enum class NumbersFound { all, too_few, too_many, not_a_number };

// Exactly as many numbers as `values` holds, nothing else. Infinities and NaN are read: the caller says what they mean.
inline NumbersFound read_numbers(std::string_view text, std::span<double> values) {
    constexpr std::string_view separators = " \t\r,";
    char const *at = text.data(), *const end = at + text.size();
    auto const skip = [&] {
        while (at != end && separators.find(*at) != std::string_view::npos) ++at;
    };
    skip();
    for (double& value : values) {
        if (at == end) return NumbersFound::too_few;
        if (*at == '+' && end - at > 1 && at[1] != '-') ++at;
        auto const [next, error] = std::from_chars(at, end, value);
        if (error != std::errc{} || (next != end && separators.find(*next) == std::string_view::npos))
            return NumbersFound::not_a_number;
        at = next;
        skip();
    }
    return at == end ? NumbersFound::all : NumbersFound::too_many;
}

}  // namespace iride
