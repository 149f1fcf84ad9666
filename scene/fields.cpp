// SPDX-License-Identifier: Apache-2.0
#include "scene/fields.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace iride {

void ReadContext::error(JsonValue const& at, std::string const& key_path, std::string const& message) {
    diagnostics.push_back({{file.string(), at.line, at.column}, key_path, message});
}

std::string Remark::text() const {
    std::string const more = key_paths.size() > 1 ? fmt::format(" and {} more", key_paths.size() - 1) : "";
    return key_paths.front() + more + ": " + message;
}

void ReadContext::remark(std::string const& key_path, std::string const& message) {
    auto const known = std::ranges::find(remarks, message, &Remark::message);
    if (known == remarks.end())
        remarks.push_back({message, {key_path}});
    else
        known->key_paths.push_back(key_path);
}

void ReadContext::guarded(JsonValue const& at, std::string const& key_path, std::function<void()> const& read) {
    try {
        read();
    } catch (InputError const& e) {
        for (Diagnostic const& d : e.diagnostics()) {
            std::string place = d.where.file;
            if (d.where.line > 0) place += fmt::format(":{}:{}", d.where.line, d.where.column);
            error(at, key_path, place.empty() ? d.message : place + ": " + d.message);
        }
    }
}

std::string Limits::text() const {
    bool const low = std::isfinite(least), high = std::isfinite(most);
    if (low && high) return fmt::format("{} {} .. {}", least_excluded ? "above" : "in", least, most);
    if (low) return fmt::format("{} {}", least_excluded ? "above" : "at least", least);
    if (high) return fmt::format("at most {}", most);
    return "finite";
}

Fields::Fields(ReadContext& context, JsonValue const& value, std::string key_path)
    : context_(context), value_(value), object_(value.as<JsonObject>()), key_path_(std::move(key_path)) {
    if (!object_) context_.error(value, key_path_, fmt::format("found {}, but an object is wanted", value.described()));
}

JsonValue const* Fields::find(std::string const& key) {
    if (std::ranges::find(known_, key) == known_.end()) known_.push_back(key);
    if (!object_) return nullptr;
    auto const found = std::ranges::find(*object_, key, [](auto const& entry) { return entry.first; });
    return found == object_->end() ? nullptr : &found->second;
}

JsonValue const* Fields::require(std::string const& key) {
    JsonValue const* const v = find(key);
    if (!v && object_) error(fmt::format("the key '{}' is missing", key));
    return v;
}

void Fields::error_at(std::string const& key, std::string const& message) {
    JsonValue const* const v = find(key);
    context_.error(v ? *v : value_, path(key), message);
}

std::optional<double> Fields::number(std::string const& key, Limits const& limits) {
    JsonValue const* const v = find(key);
    if (!v) return std::nullopt;
    double const* const x = v->as<double>();
    if (!x) {
        error_at(key, fmt::format("found {}, but a number is wanted", v->described()));
        return std::nullopt;
    }
    if (limits.hold(*x)) return *x;
    error_at(key, fmt::format("found {}, allowed: {}", *x, limits.text()));
    return std::nullopt;
}

std::optional<int> Fields::integer(std::string const& key, int least, int most) {
    auto const x = number(key, between(least, most));
    if (x && *x != std::floor(*x)) {
        error_at(key, fmt::format("found {}, but a whole number is wanted", *x));
        return std::nullopt;
    }
    return x ? std::optional(static_cast<int>(*x)) : std::nullopt;
}

std::optional<bool> Fields::boolean(std::string const& key) {
    JsonValue const* const v = find(key);
    if (!v) return std::nullopt;
    if (bool const* const b = v->as<bool>()) return *b;
    error_at(key, fmt::format("found {}, allowed: true, false", v->described()));
    return std::nullopt;
}

std::optional<std::string> Fields::text(std::string const& key) {
    JsonValue const* const v = find(key);
    if (!v) return std::nullopt;
    if (std::string const* const s = v->as<std::string>()) return *s;
    error_at(key, fmt::format("found {}, but a string is wanted", v->described()));
    return std::nullopt;
}

std::optional<std::string> Fields::choice(std::string const& key, std::vector<std::string> const& allowed) {
    auto const s = text(key);
    if (!s || std::ranges::find(allowed, *s) != allowed.end()) return s;
    error_at(key, fmt::format("found '{}'{}", *s, suggestion(*s, allowed)));
    return std::nullopt;
}

std::optional<VectorDouble> Fields::vector(std::string const& key) {
    JsonValue const* const v = find(key);
    return v ? read_vector(context_, *v, path(key)) : std::nullopt;
}

std::optional<std::vector<double>> Fields::numbers(std::string const& key, std::size_t count) {
    JsonValue const* const v = find(key);
    return v ? read_numbers(context_, *v, path(key), count) : std::nullopt;
}

double Fields::required_number(std::string const& key, Limits const& limits) {
    require(key);
    return number(key, limits).value_or(1);
}

VectorDouble Fields::required_vector(std::string const& key) {
    require(key);
    return vector(key).value_or(VectorDouble(0, 0, 1));
}

void Fields::finish() {
    if (!object_) return;
    for (auto const& [key, v] : *object_)
        if (std::ranges::find(known_, key) == known_.end())
            context_.error(v, path(key), "unknown key" + suggestion(key, known_));
}

bool has_key(JsonValue const& value, std::string const& key) {
    JsonObject const* const object = value.as<JsonObject>();
    return object && std::ranges::any_of(*object, [&](auto const& entry) { return entry.first == key; });
}

std::optional<std::vector<double>> read_numbers(ReadContext& context, JsonValue const& value, std::string const& path,
                                                std::size_t count) {
    JsonArray const* const array = value.as<JsonArray>();
    std::vector<double> numbers;
    if (array)
        for (JsonValue const& element : *array)
            if (double const* x = element.as<double>(); x && std::isfinite(*x)) numbers.push_back(*x);
    if (array && array->size() == count && numbers.size() == count) return numbers;
    context.error(value, path, fmt::format("found {}, but an array of {} numbers is wanted", value.described(), count));
    return std::nullopt;
}

std::optional<VectorDouble> read_vector(ReadContext& context, JsonValue const& value, std::string const& path) {
    auto const n = read_numbers(context, value, path, 3);
    return n ? std::optional(VectorDouble((*n)[0], (*n)[1], (*n)[2])) : std::nullopt;
}

}  // namespace iride
