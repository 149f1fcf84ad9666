// SPDX-License-Identifier: Apache-2.0
#include "scene/mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <fstream>
#include <system_error>

#include "scene/mesh_formats.h"

namespace iride {

namespace {

constexpr std::uintmax_t largest_file = 1ull << 30;  // bytes; a binary PLY of some 20 million vertices

[[noreturn]] void fail_file(std::filesystem::path const& path, std::string message) {
    throw InputError({path.string()}, "", std::move(message));
}

std::string read_bytes(std::filesystem::path const& path) {
    std::error_code error;
    auto const status = std::filesystem::status(path, error);
    if (!std::filesystem::exists(status)) fail_file(path, "no such file");
    if (!std::filesystem::is_regular_file(status)) fail_file(path, "a folder or device; a mesh file is allowed");
    auto const size = std::filesystem::file_size(path, error);
    if (error) fail_file(path, "cannot be read: " + error.message());
    if (size == 0) fail_file(path, "the file is empty");
    if (size > largest_file)
        fail_file(path, fmt::format("has {} MiB, allowed: at most {} MiB", size >> 20, largest_file >> 20));
    std::ifstream stream(path, std::ios::binary);
    std::string bytes(size, '\0');
    if (!stream.read(bytes.data(), static_cast<std::streamsize>(size)))
        fail_file(path, fmt::format("cannot be read: {} of {} bytes came", stream.gcount(), size));
    return bytes;
}

bool is_space(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f'; }

}  // namespace

Token TextCursor::next_on_line() {
    while (at_ < text_.size() && is_space(text_[at_])) ++at_;
    std::size_t const begin = at_;
    while (at_ < text_.size() && !is_space(text_[at_]) && text_[at_] != '\n') ++at_;
    return {text_.substr(begin, at_ - begin), line_, static_cast<int>(begin - line_start_) + 1};
}

Token TextCursor::next() {
    Token token = next_on_line();
    while (token.text.empty() && !at_end()) {
        skip_line();
        token = next_on_line();
    }
    return token;
}

void TextCursor::skip_line() {
    std::size_t const end = text_.find('\n', at_);
    if (end == std::string_view::npos) {
        at_ = text_.size();
        return;
    }
    at_ = line_start_ = end + 1;
    ++line_;
}

std::optional<double> to_number(std::string_view text) {
    if (text.starts_with('+')) text.remove_prefix(1);
    double value = 0;
    auto const [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size()) return {};
    return value;
}

std::optional<std::int64_t> to_integer(std::string_view text) {
    std::int64_t value = 0;
    auto const [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size()) return {};
    return value;
}

void fail_at(std::string const& file, Token const& token, std::string message) {
    throw InputError({file, token.line, token.column}, "", std::move(message));
}

std::optional<Vector> unit_vector(double x, double y, double z) {
    double const length = std::hypot(x, y, z);
    if (!(length > 0) || !std::isfinite(length)) return {};
    return Vector(VectorDouble(x / length, y / length, z / length).cast<float>());
}

void append_polygon(Mesh& mesh, std::span<std::uint32_t const> polygon) {
    for (std::size_t i = 2; i < polygon.size(); ++i) mesh.triangle.push_back({polygon[0], polygon[i - 1], polygon[i]});
}

Mesh read_mesh(std::filesystem::path const& path, VectorDouble const& origin) {
    std::string extension = path.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    if (extension != ".ply" && extension != ".obj")
        fail_file(path, fmt::format("'{}' is no mesh format; allowed: .ply, .obj", extension));
    std::string const bytes = read_bytes(path);
    Mesh mesh = extension == ".ply" ? parse_ply(bytes, path.string(), origin) : parse_obj(bytes, path.string(), origin);
    check_mesh(mesh, path);
    return mesh;
}

void check_mesh(Mesh const& mesh, std::filesystem::path const& path) {
    std::size_t const count = mesh.position.size();
    for (std::size_t i = 0; i < count; ++i)
        if (!mesh.position[i].allFinite())
            fail_file(path, fmt::format("vertex {}: ({}, {}, {}) is not finite", i, mesh.position[i].x(),
                                        mesh.position[i].y(), mesh.position[i].z()));
    for (std::size_t i = 0; i < mesh.triangle.size(); ++i)
        for (std::uint32_t const v : mesh.triangle[i])
            if (v >= count)
                fail_file(path, fmt::format("triangle {}: vertex {}; allowed: 0 .. {}", i, v,
                                            static_cast<std::int64_t>(count) - 1));
    if (mesh.triangle.empty()) fail_file(path, "no triangle");
    if (!mesh.normal.empty() && mesh.normal.size() != count)
        fail_file(path, fmt::format("{} normals for {} vertices", mesh.normal.size(), count));
    if (!mesh.uv.empty() && mesh.uv.size() != count)
        fail_file(path, fmt::format("{} texture coordinates for {} vertices", mesh.uv.size(), count));
}

}  // namespace iride
