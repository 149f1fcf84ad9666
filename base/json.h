// SPDX-License-Identifier: Apache-2.0
// JSON that remembers where it stands: every value knows its line and column, so that a reader can say where and what
// is wrong. `//` and `/* */` comments are allowed. Built on nlohmann::json's event parser.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "base/diagnostics.h"

namespace iride {

struct JsonValue;
using JsonArray = std::vector<JsonValue>;
using JsonObject = std::vector<std::pair<std::string, JsonValue>>;  // in the file's order

struct JsonValue {
    std::variant<std::nullptr_t, bool, double, std::string, JsonArray, JsonObject> value = nullptr;
    int line = 0, column = 0;  // of the value's first character, from 1

    template <class T>
    T const* as() const {
        return std::get_if<T>(&value);
    }
    // "a number", "a string", "an array of 3", ...: what a message says was found.
    std::string described() const;
};

// Parse a text or a file. Throws InputError with file:line:column for a syntax error, a repeated key of one object, a
// number that overflows a double, nesting deeper than 64, an empty file, a missing file, a file that is a folder, or
// one larger than 256 MiB (the size is looked at before anything is read).
JsonValue parse_json(std::string_view text, std::string const& file_name);
JsonValue read_json(std::filesystem::path const& path);

}  // namespace iride
