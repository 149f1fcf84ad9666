// SPDX-License-Identifier: Apache-2.0
// Reading the keys of a JSON object: each is asked for by name and type, errors are collected with their place, and
// what was never asked for is reported at the end.
#pragma once

#include <filesystem>
#include <functional>
#include <limits>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "base/json.h"
#include "base/vector.h"

namespace iride {

// What is worth saying but no error, with every place it holds for.
struct Remark {
    std::string message;
    std::vector<std::string> key_paths;

    // "first.key.path and 3 more: message"
    std::string text() const;
};

// Where a file's diagnostics go.
struct ReadContext {
    std::filesystem::path file, folder;
    std::vector<Diagnostic> diagnostics;
    std::vector<Remark> remarks;
    std::vector<std::filesystem::path> files_read;

    void error(JsonValue const& at, std::string const& key_path, std::string const& message);
    // The same message from several places is one remark.
    void remark(std::string const& key_path, std::string const& message);
    // Run `read`; an InputError of another file or library becomes a diagnostic here.
    void guarded(JsonValue const& at, std::string const& key_path, std::function<void()> const& read);
};

struct Limits {
    double least = -std::numeric_limits<double>::infinity(), most = std::numeric_limits<double>::infinity();
    bool least_excluded = false;
    std::string text() const;
    bool hold(double x) const { return std::isfinite(x) && (least_excluded ? x > least : x >= least) && x <= most; }
};
inline Limits positive() { return {.least = 0, .least_excluded = true}; }
inline Limits at_least(double least) { return {.least = least}; }
inline Limits between(double least, double most) { return {.least = least, .most = most}; }

class Fields {
  public:
    // `value` must be an object; if it is not, that is reported once and every key is absent.
    Fields(ReadContext& context, JsonValue const& value, std::string key_path);

    // The value of a key, or null. Marks the key as known.
    JsonValue const* find(std::string const& key);
    // The same; absence is an error.
    JsonValue const* require(std::string const& key);

    std::optional<double> number(std::string const& key, Limits const& limits = {});
    std::optional<int> integer(std::string const& key, int least, int most);
    std::optional<bool> boolean(std::string const& key);
    std::optional<std::string> text(std::string const& key);
    // A text that must be one of `allowed`.
    std::optional<std::string> choice(std::string const& key, std::vector<std::string> const& allowed);
    std::optional<VectorDouble> vector(std::string const& key);
    std::optional<std::vector<double>> numbers(std::string const& key, std::size_t count);

    // As above, but absence is an error; the return value is only good if no diagnostic was made.
    double required_number(std::string const& key, Limits const& limits = {});
    VectorDouble required_vector(std::string const& key);

    // Report keys that nobody asked for, with the nearest known one.
    void finish();

    std::string path(std::string const& key) const { return key_path_.empty() ? key : key_path_ + "." + key; }
    void error(std::string const& message) { context_.error(value_, key_path_, message); }
    void error_at(std::string const& key, std::string const& message);
    ReadContext& context() { return context_; }
    JsonValue const& value() const { return value_; }
    std::string const& key_path() const { return key_path_; }

  private:
    ReadContext& context_;
    JsonValue const& value_;
    JsonObject const* object_;
    std::string key_path_;
    std::vector<std::string> known_;
};

// Whether a value is an object that has this key.
bool has_key(JsonValue const& value, std::string const& key);

// Numbers of a JSON array of exactly `count` finite numbers; reports otherwise.
std::optional<std::vector<double>> read_numbers(ReadContext& context, JsonValue const& value, std::string const& path,
                                                std::size_t count);
std::optional<VectorDouble> read_vector(ReadContext& context, JsonValue const& value, std::string const& path);

}  // namespace iride
