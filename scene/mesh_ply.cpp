// SPDX-License-Identifier: Apache-2.0
// PLY, ascii and binary of either byte order: a header that declares elements and their properties, then their rows.
// Read are the element "vertex" (x y z, nx ny nz, and u v, s t or texture_u texture_v) and the list vertex_indices or
// vertex_index of "face"; other elements and properties are passed over. [Turk 1994]
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <type_traits>
#include <utility>

#include "scene/mesh_formats.h"

namespace iride {

namespace {

enum class Type { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

struct TypeName {
    std::string_view name, alias;
    Type type;
    std::size_t bytes;
};
constexpr std::array<TypeName, 8> types{{{"char", "int8", Type::int8, 1},
                                         {"uchar", "uint8", Type::uint8, 1},
                                         {"short", "int16", Type::int16, 2},
                                         {"ushort", "uint16", Type::uint16, 2},
                                         {"int", "int32", Type::int32, 4},
                                         {"uint", "uint32", Type::uint32, 4},
                                         {"float", "float32", Type::float32, 4},
                                         {"double", "float64", Type::float64, 8}}};

std::size_t size_of(Type type) { return types[static_cast<std::size_t>(type)].bytes; }
bool is_whole(Type type) { return type != Type::float32 && type != Type::float64; }

struct Property {
    std::string name;
    Type type;
    std::optional<Type> count_type;  // of a list
};

struct Element {
    std::string name;
    std::uint64_t count = 0;
    std::vector<Property> properties;
    Token where;
};

enum class Format { ascii, little_endian, big_endian };

struct Header {
    Format format = Format::ascii;
    std::vector<Element> elements;

    std::uint64_t count(std::string_view name) const {
        auto const found =
            std::find_if(elements.begin(), elements.end(), [&](Element const& e) { return e.name == name; });
        return found == elements.end() ? 0 : found->count;
    }
};

class HeaderParser {
  public:
    HeaderParser(TextCursor& cursor, std::string const& file) : cursor_(cursor), file_(file) {}

    Header parse() {
        Token const magic = cursor_.next_on_line();
        if (magic.text != "ply") fail_at(file_, magic, "the file does not begin with 'ply'");
        for (;;) {
            cursor_.skip_line();
            if (cursor_.at_end()) fail_at(file_, cursor_.next_on_line(), "the file ends inside the header");
            Token const keyword = cursor_.next_on_line();
            if (keyword.text == "end_header") break;
            line(keyword);
        }
        if (!has_format_) fail_at(file_, magic, "the header names no format");
        cursor_.skip_line();
        return std::move(header_);
    }

  private:
    void line(Token const& keyword) {
        if (keyword.text == "format") {
            format();
        } else if (keyword.text == "element") {
            element(keyword);
        } else if (keyword.text == "property") {
            property(keyword);
        } else if (keyword.text != "comment" && keyword.text != "obj_info" && !keyword.text.empty()) {
            fail_at(file_, keyword,
                    fmt::format("'{}' in the header; allowed: format, element, property, comment, obj_info, end_header",
                                keyword.text));
        }
    }

    void format() {
        Token const name = cursor_.next_on_line(), version = cursor_.next_on_line();
        if (name.text == "ascii") {
            header_.format = Format::ascii;
        } else if (name.text == "binary_little_endian") {
            header_.format = Format::little_endian;
        } else if (name.text == "binary_big_endian") {
            header_.format = Format::big_endian;
        } else {
            fail_at(file_, name,
                    fmt::format("format '{}'; allowed: ascii, binary_little_endian, binary_big_endian", name.text));
        }
        if (version.text != "1.0") fail_at(file_, version, fmt::format("version '{}'; allowed: 1.0", version.text));
        has_format_ = true;
    }

    void element(Token const& keyword) {
        Token const name = cursor_.next_on_line(), number = cursor_.next_on_line();
        auto const count = to_integer(number.text);
        if (name.text.empty() || !count || *count < 0)
            fail_at(
                file_, number,
                fmt::format("element '{}' of count '{}'; a whole number from 0 is allowed", name.text, number.text));
        for (Element const& e : header_.elements)
            if (e.name == name.text) fail_at(file_, keyword, fmt::format("element '{}' a second time", name.text));
        header_.elements.push_back({std::string(name.text), static_cast<std::uint64_t>(*count), {}, number});
    }

    void property(Token const& keyword) {
        if (header_.elements.empty()) fail_at(file_, keyword, "a property before the first element");
        Element& owner = header_.elements.back();
        Property p;
        Token token = cursor_.next_on_line();
        if (token.text == "list") {
            Token const count = cursor_.next_on_line();
            p.count_type = type(count);
            if (!is_whole(*p.count_type)) fail_at(file_, count, "a list's count must have a whole-number type");
            token = cursor_.next_on_line();
        }
        p.type = type(token);
        Token const name = cursor_.next_on_line();
        if (name.text.empty()) fail_at(file_, name, "a property without a name");
        p.name = name.text;
        for (Property const& other : owner.properties)
            if (other.name == p.name) fail_at(file_, name, fmt::format("property '{}' a second time", p.name));
        owner.properties.push_back(std::move(p));
    }

    Type type(Token const& token) const {
        for (TypeName const& t : types)
            if (token.text == t.name || token.text == t.alias) return t.type;
        fail_at(file_, token,
                fmt::format("type '{}'; allowed: char, uchar, short, ushort, int, uint, float, double", token.text));
    }

    TextCursor& cursor_;
    std::string const& file_;
    Header header_;
    bool has_format_ = false;
};

// The rows as a stream of numbers. Every type fits a double exactly.
class AsciiBody {
  public:
    AsciiBody(std::string_view text, TextCursor const& begin, std::string const& file)
        : size_(text.size()), cursor_(begin), file_(file) {}

    double read(Type type) {
        last_ = cursor_.next();
        if (last_.text.empty()) fail("the file ends inside its data");
        auto const value = to_number(last_.text);
        if (!value) fail(fmt::format("'{}'; a number is allowed", last_.text));
        if (is_whole(type) && *value != std::floor(*value))
            fail(fmt::format("{}; a whole number is allowed", last_.text));
        return *value;
    }
    // At least a digit and a space each, the last without the space.
    std::uint64_t most_values(Type) const { return (size_ - cursor_.offset() + 1) / 2; }
    void finish() {
        last_ = cursor_.next();
        if (!last_.text.empty()) fail("data after the last element");
    }
    [[noreturn]] void fail(std::string message) const { fail_at(file_, last_, std::move(message)); }

  private:
    std::size_t size_;
    TextCursor cursor_;
    std::string const& file_;
    Token last_;
};

template <bool big_endian>
class BinaryBody {
  public:
    BinaryBody(std::string_view bytes, TextCursor const& begin, std::string const& file)
        : bytes_(bytes), at_(begin.offset()), last_(at_), file_(file) {}

    double read(Type type) {
        switch (type) {
            case Type::int8:
                return value<std::int8_t>();
            case Type::uint8:
                return value<std::uint8_t>();
            case Type::int16:
                return value<std::int16_t>();
            case Type::uint16:
                return value<std::uint16_t>();
            case Type::int32:
                return value<std::int32_t>();
            case Type::uint32:
                return value<std::uint32_t>();
            case Type::float32:
                return value<float>();
            case Type::float64:
                return value<double>();
        }
        return 0;
    }
    std::uint64_t most_values(Type type) const { return (bytes_.size() - at_) / size_of(type); }
    // White space is forgiven: some writers end the file with a newline.
    void finish() {
        last_ = at_;
        if (bytes_.find_first_not_of(" \t\r\n", at_) != std::string_view::npos)
            fail(fmt::format("{} bytes after the last element", bytes_.size() - at_));
    }
    [[noreturn]] void fail(std::string message) const {
        throw InputError({file_}, "", fmt::format("byte {}: {}", last_, message));
    }

  private:
    template <class T>
    double value() {
        last_ = at_;
        if (bytes_.size() - at_ < sizeof(T)) fail("the file ends inside its data");
        std::array<char, sizeof(T)> raw;
        std::memcpy(raw.data(), bytes_.data() + at_, sizeof(T));
        if (big_endian != (std::endian::native == std::endian::big)) std::reverse(raw.begin(), raw.end());
        at_ += sizeof(T);
        return static_cast<double>(std::bit_cast<T>(raw));
    }

    std::string_view bytes_;
    std::size_t at_, last_;  // the next value, the one just read
    std::string const& file_;
};

template <class Body>
class BodyReader {
  public:
    BodyReader(Header const& header, Body body, std::string const& file, VectorDouble const& origin)
        : header_(header), body_(std::move(body)), file_(file), origin_(origin) {}

    Mesh read() {
        for (Element const& element : header_.elements) {
            check_count(element);
            if (element.name == "vertex") {
                read_vertices(element);
            } else if (element.name == "face") {
                read_faces(element);
            } else {
                for (std::uint64_t i = 0; i < element.count; ++i)
                    for (Property const& p : element.properties) skip(p);
            }
        }
        body_.finish();
        return std::move(mesh_);
    }

  private:
    // Before anything is allocated: the rest of the file must have room for the shortest possible rows.
    void check_count(Element const& element) {
        std::uint64_t most = std::numeric_limits<std::uint32_t>::max();  // as many as a triangle can number
        for (Property const& p : element.properties)
            most = std::min(most, body_.most_values(p.count_type.value_or(p.type)));
        if (element.count > most)
            fail_at(file_, element.where,
                    fmt::format("element '{}' announces {} rows; the rest of the file holds at most {}", element.name,
                                element.count, most));
        if (element.properties.empty() && element.count > 0)
            fail_at(file_, element.where, fmt::format("element '{}' has no properties", element.name));
    }

    std::uint64_t list_length(Property const& list) {
        double const length = body_.read(*list.count_type);
        if (length < 0 || length > static_cast<double>(body_.most_values(list.type)))
            body_.fail(fmt::format("a list of {} numbers; the rest of the file holds at most {}", length,
                                   body_.most_values(list.type)));
        return static_cast<std::uint64_t>(length);
    }

    void skip(Property const& p) {
        std::uint64_t const length = p.count_type ? list_length(p) : 1;
        for (std::uint64_t i = 0; i < length; ++i) body_.read(p.type);
    }

    // Column of each property in a row {x, y, z, nx, ny, nz, u, v}; -1 for those passed over.
    static std::vector<int> columns(Element const& element) {
        constexpr std::array<std::array<std::string_view, 3>, 8> names{
            {{"x"}, {"y"}, {"z"}, {"nx"}, {"ny"}, {"nz"}, {"u", "s", "texture_u"}, {"v", "t", "texture_v"}}};
        std::vector<int> column;
        for (Property const& p : element.properties) {
            auto const found = std::find_if(names.begin(), names.end(), [&](auto const& aliases) {
                return !p.count_type && std::find(aliases.begin(), aliases.end(), p.name) != aliases.end();
            });
            column.push_back(found == names.end() ? -1 : static_cast<int>(found - names.begin()));
        }
        return column;
    }

    double finite(double value, std::uint64_t vertex) const {
        if (!std::isfinite(static_cast<float>(value)))
            body_.fail(fmt::format("vertex {}: {} is not finite", vertex, value));
        return value;
    }

    void read_vertices(Element const& element) {
        std::vector<int> const column = columns(element);
        auto const has = [&](int c) { return std::find(column.begin(), column.end(), c) != column.end(); };
        if (!has(0) || !has(1) || !has(2)) fail_at(file_, element.where, "element 'vertex' needs x, y and z");
        bool const normals = has(3) && has(4) && has(5), uvs = has(6) && has(7);
        auto const count = static_cast<std::size_t>(element.count);
        mesh_.position.reserve(count);
        if (normals) mesh_.normal.reserve(count);
        if (uvs) mesh_.uv.reserve(count);
        std::array<double, 8> row{};
        for (std::uint64_t i = 0; i < element.count; ++i) {
            for (std::size_t p = 0; p < column.size(); ++p) {
                if (column[p] < 0) {
                    skip(element.properties[p]);
                } else {
                    row[static_cast<std::size_t>(column[p])] = finite(body_.read(element.properties[p].type), i);
                }
            }
            mesh_.position.push_back((VectorDouble(row[0], row[1], row[2]) - origin_).cast<float>());
            if (uvs) mesh_.uv.emplace_back(static_cast<float>(row[6]), static_cast<float>(row[7]));
            if (!normals) continue;
            auto const unit = unit_vector(row[3], row[4], row[5]);
            if (!unit) body_.fail(fmt::format("vertex {}: a normal of length 0", i));
            mesh_.normal.push_back(*unit);
        }
    }

    void read_faces(Element const& element) {
        auto const is_indices = [](Property const& p) {
            return p.count_type && is_whole(p.type) && (p.name == "vertex_indices" || p.name == "vertex_index");
        };
        if (element.count > 0 && std::none_of(element.properties.begin(), element.properties.end(), is_indices))
            fail_at(file_, element.where,
                    "element 'face' needs a list of whole numbers vertex_indices or vertex_index");
        double const vertices = static_cast<double>(header_.count("vertex"));
        mesh_.triangle.reserve(static_cast<std::size_t>(element.count));
        std::vector<std::uint32_t> polygon;
        for (std::uint64_t i = 0; i < element.count; ++i)
            for (Property const& p : element.properties) {
                if (!is_indices(p)) {
                    skip(p);
                    continue;
                }
                polygon.resize(static_cast<std::size_t>(list_length(p)));
                if (polygon.size() < 3)
                    body_.fail(fmt::format("face {} has {} corners; at least 3 are needed", i, polygon.size()));
                for (std::uint32_t& v : polygon) {
                    double const index = body_.read(p.type);
                    if (!(index >= 0 && index < vertices))
                        body_.fail(fmt::format("face {}: vertex {}; allowed: 0 .. {}", i, index, vertices - 1));
                    v = static_cast<std::uint32_t>(index);
                }
                append_polygon(mesh_, polygon);
            }
    }

    Header const& header_;
    Body body_;
    std::string const& file_;
    VectorDouble origin_;
    Mesh mesh_;
};

}  // namespace

Mesh parse_ply(std::string_view bytes, std::string const& file, VectorDouble const& origin) {
    TextCursor cursor(bytes);
    Header const header = HeaderParser(cursor, file).parse();
    auto const read = [&]<class Body>(std::type_identity<Body>) {
        return BodyReader<Body>(header, Body(bytes, cursor, file), file, origin).read();
    };
    switch (header.format) {
        case Format::ascii:
            return read(std::type_identity<AsciiBody>());
        case Format::little_endian:
            return read(std::type_identity<BinaryBody<false>>());
        case Format::big_endian:
            return read(std::type_identity<BinaryBody<true>>());
    }
    return {};
}

}  // namespace iride
