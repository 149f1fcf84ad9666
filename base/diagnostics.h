// SPDX-License-Identifier: Apache-2.0
// What is wrong with an input: collected until a whole file has been read, then thrown together as one InputError.
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace iride {

// A place in a file. line and column count from 1; 0 means "the file as a whole".
struct SourceLocation {
    std::string file;
    int line = 0, column = 0;
};

struct Diagnostic {
    SourceLocation where;
    std::string key_path;  // e.g. "shapes[3].material"; empty when there is none
    std::string message;   // what was found, what is allowed

    // "file:line:column: key.path: message"
    std::string text() const;
};

// Bad input, with every diagnostic found. what() is one line per diagnostic.
class InputError : public std::runtime_error {
  public:
    explicit InputError(std::vector<Diagnostic> diagnostics);
    InputError(SourceLocation where, std::string key_path, std::string message);
    std::vector<Diagnostic> const& diagnostics() const { return diagnostics_; }

  private:
    std::vector<Diagnostic> diagnostics_;
};

// The candidate with the smallest edit distance (Levenshtein, transpositions counting once) to `name`, if near enough
// to be a slip of the pen: at most a third of its length, at least 1, but not all of it. Empty if there is none.
std::string nearest_name(std::string_view name, std::vector<std::string> const& candidates);

// "; did you mean 'x'?" or, without a near candidate, "; allowed: a, b, c".
std::string suggestion(std::string_view name, std::vector<std::string> const& candidates);

}  // namespace iride
