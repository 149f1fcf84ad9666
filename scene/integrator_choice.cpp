// SPDX-License-Identifier: Apache-2.0
#include "scene/integrator_choice.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

namespace iride {

namespace {

JsonValue parsed_value(std::string const& word) {
    if (word == "true" || word == "false") return {word == "true"};
    double number = 0;
    auto const [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
    if (error == std::errc{} && end == word.data() + word.size()) return {number};
    return {word};
}

std::string written(JsonValue const& v) {
    if (auto const* b = v.as<bool>()) return *b ? "true" : "false";
    if (auto const* x = v.as<double>()) return fmt::format("{}", *x);
    if (auto const* s = v.as<std::string>()) return *s;
    return v.described();
}

}  // namespace

std::string IntegratorChoice::text() const {
    std::string all = name;
    if (auto const* object = options.as<JsonObject>())
        for (auto const& [key, value] : *object)
            all += fmt::format("{}{}={}", all.size() == name.size() ? ':' : ',', key, written(value));
    return all;
}

IntegratorChoice parse_integrator(std::string const& text) {
    IntegratorChoice choice;
    std::size_t const colon = text.find(':');
    choice.name = text.substr(0, colon);
    choice.key_path = "--integrator";
    JsonObject options;
    for (std::size_t from = colon; from < text.size();) {
        std::size_t const end = std::min(text.find(',', from + 1), text.size());
        std::string const pair = text.substr(from + 1, end - from - 1);
        std::size_t const equals = pair.find('=');
        if (equals == 0 || equals == std::string::npos || equals + 1 == pair.size())
            throw InputError({}, choice.key_path,
                             fmt::format("found '{}', allowed: NAME or NAME:key=value,key=value", text));
        std::string const key = pair.substr(0, equals);
        if (std::ranges::any_of(options, [&](auto const& entry) { return entry.first == key; }))
            throw InputError({}, choice.key_path, fmt::format("the key '{}' stands twice in '{}'", key, text));
        options.emplace_back(key, parsed_value(pair.substr(equals + 1)));
        from = end;
    }
    choice.options.value = std::move(options);
    return choice;
}

}  // namespace iride
