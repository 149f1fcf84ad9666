// SPDX-License-Identifier: Apache-2.0
// Numbers as our own files write them in one line of text.
#pragma once

#include <charconv>
#include <optional>
#include <string_view>
#include <vector>

namespace iride {

// Exactly `count` numbers with one character between them; nothing if the text is anything else.
template <class Number>
std::optional<std::vector<Number>> numbers_in(std::string_view text, std::size_t count) {
    std::vector<Number> all;
    char const *at = text.data(), *const end = at + text.size();
    while (all.size() < count) {
        Number number{};
        auto const [next, error] = std::from_chars(at, end, number);
        if (error != std::errc()) return std::nullopt;
        all.push_back(number);
        at = next == end ? end : next + 1;
    }
    if (at != end) return std::nullopt;
    return all;
}

}  // namespace iride
