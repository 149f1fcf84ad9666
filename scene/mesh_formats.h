// SPDX-License-Identifier: Apache-2.0
// What the mesh readers share: a cursor over text that knows its line and column, and the pieces a mesh is made of.
// Both readers stop at the first error: behind it a mesh file is rarely worth a message.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "base/diagnostics.h"
#include "scene/mesh.h"

namespace iride {

// A word of a text file and where it stands, from 1; empty at the end of the line or text.
struct Token {
    std::string_view text;
    int line = 0, column = 0;
};

class TextCursor {
  public:
    explicit TextCursor(std::string_view text, std::size_t offset = 0, int line = 1)
        : text_(text), at_(offset), line_start_(offset), line_(line) {}

    Token next_on_line();  // empty at the end of the line, which is not passed
    Token next();          // crosses lines; empty at the end of the text
    void skip_line();      // to the beginning of the next line

    bool at_end() const { return at_ >= text_.size(); }
    std::size_t offset() const { return at_; }
    int line() const { return line_; }

  private:
    std::string_view text_;
    std::size_t at_, line_start_;
    int line_;
};

// The whole token as a number ("nan" and "inf" are numbers here) or as a whole number; nothing if it is none.
std::optional<double> to_number(std::string_view text);
std::optional<std::int64_t> to_integer(std::string_view text);

[[noreturn]] void fail_at(std::string const& file, Token const& token, std::string message);

// The unit vector along (x, y, z); nothing if its length is zero or not finite.
std::optional<Vector> unit_vector(double x, double y, double z);

// A polygon as a fan of triangles around its first corner.
void append_polygon(Mesh& mesh, std::span<std::uint32_t const> polygon);

// A file's content as a mesh; `file` is for messages. Indices are checked against the file's own counts. Positions
// count from `origin`, which is taken off before they become floats.
Mesh parse_ply(std::string_view bytes, std::string const& file, VectorDouble const& origin);
Mesh parse_obj(std::string_view text, std::string const& file, VectorDouble const& origin);

}  // namespace iride
