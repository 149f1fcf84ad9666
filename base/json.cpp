// SPDX-License-Identifier: Apache-2.0
#include "base/json.h"

#include <fmt/format.h>

#include <cmath>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

namespace iride {

namespace {

constexpr int deepest = 64;
constexpr std::uintmax_t largest_file = 256ull << 20;  // bytes

using Library = nlohmann::json;

// Reads the text for the library and shares how far it has come.
struct CountingIterator {
    using iterator_category = std::input_iterator_tag;
    using value_type = char;
    using difference_type = std::ptrdiff_t;
    using pointer = char const*;
    using reference = char const&;

    char const* at = nullptr;
    char const** consumed = nullptr;

    reference operator*() const { return *at; }
    CountingIterator& operator++() {
        ++at;
        if (consumed) *consumed = at;
        return *this;
    }
    CountingIterator operator++(int) {
        CountingIterator const before = *this;
        ++*this;
        return before;
    }
    friend bool operator==(CountingIterator a, CountingIterator b) { return a.at == b.at; }
    friend bool operator!=(CountingIterator a, CountingIterator b) { return a.at != b.at; }
};

struct Position {
    int line, column;
};

// Builds the tree from the library's events. A value's place is the first character after the separators that follow
// the previous event.
class TreeBuilder : public nlohmann::json_sax<Library> {
  public:
    TreeBuilder(std::string_view text, std::string file) : text_(text), file_(std::move(file)), scanned_(text.data()) {}

    char const* consumed = nullptr;
    JsonValue root;

    bool null() override { return put(nullptr); }
    bool boolean(bool b) override { return put(b); }
    bool number_integer(number_integer_t n) override { return put(static_cast<double>(n)); }
    bool number_unsigned(number_unsigned_t n) override { return put(static_cast<double>(n)); }
    bool number_float(number_float_t n, string_t const& text) override {
        if (!std::isfinite(n)) fail(place(), "the number " + text.substr(0, 40) + " is too large");
        return put(static_cast<double>(n));
    }
    bool string(string_t& s) override { return put(s); }
    bool binary(binary_t&) override { return false; }
    bool start_object(std::size_t) override { return open(JsonObject{}); }
    bool start_array(std::size_t) override { return open(JsonArray{}); }
    bool end_object() override { return close(); }
    bool end_array() override { return close(); }
    bool key(string_t& name) override {
        Position const where = place();
        auto& object = std::get<JsonObject>(open_.back()->value);
        for (auto const& entry : object)
            if (entry.first == name) fail(where, fmt::format("the key '{}' is there twice", name));
        object.emplace_back(name, JsonValue{});
        advance();
        return true;
    }
    bool parse_error(std::size_t position, std::string const&, nlohmann::detail::exception const& e) override {
        // "[json.exception.parse_error.101] parse error at line 1, column 2: syntax error while ...; expected ..."
        std::string message = e.what();
        if (auto const colon = message.find(": "); colon != std::string::npos) message.erase(0, colon + 2);
        scanned_ = text_.data();
        line_ = column_ = 1;
        std::size_t const at = std::min(position > 0 ? position - 1 : 0, text_.size());
        scan_to(text_.data() + at);
        fail({line_, column_}, message);
    }

    [[noreturn]] void fail(Position where, std::string const& message) const {
        throw InputError(Diagnostic{{file_, where.line, where.column}, "", message});
    }

  private:
    bool put(decltype(JsonValue::value) value) {
        Position const where = place();
        advance();
        slot() = JsonValue{std::move(value), where.line, where.column};
        return true;
    }
    bool open(decltype(JsonValue::value) container) {
        Position const where = place();
        if (open_.size() >= deepest) fail(where, fmt::format("nested deeper than {} levels", deepest));
        advance();
        JsonValue& here = slot();
        here = JsonValue{std::move(container), where.line, where.column};
        open_.push_back(&here);
        return true;
    }
    bool close() {
        open_.pop_back();
        advance();
        return true;
    }
    // Where the next value goes. Pointers into open_ stay good: a container grows only while it is innermost.
    JsonValue& slot() {
        if (open_.empty()) return root;
        if (JsonArray* array = std::get_if<JsonArray>(&open_.back()->value)) return array->emplace_back();
        return std::get<JsonObject>(open_.back()->value).back().second;
    }

    // Line and column of the first character of the value or key that has just been read.
    Position place() {
        char const* const end = text_.data() + text_.size();
        char const* p = scanned_;
        while (p < end) {
            if (*p == '/' && p + 1 < end && p[1] == '/') {
                while (p < end && *p != '\n') ++p;
            } else if (*p == '/' && p + 1 < end && p[1] == '*') {
                p += 2;
                while (p + 1 < end && !(p[0] == '*' && p[1] == '/')) ++p;
                p = std::min(p + 2, end);
            } else if (std::string_view(" \t\r\n,:").find(*p) != std::string_view::npos) {
                ++p;
            } else {
                break;
            }
        }
        scan_to(p);
        return {line_, column_};
    }
    void scan_to(char const* to) {
        for (; scanned_ < to; ++scanned_) {
            if (*scanned_ == '\n')
                ++line_, column_ = 1;
            else
                ++column_;
        }
    }
    // Go on behind what has been consumed. A number ends by reading one character too many, perhaps a bracket.
    void advance() {
        char const* end = consumed ? consumed : text_.data();
        if (end > scanned_ && end > text_.data()) {
            char const last = end[-1];
            bool const ends_itself = *scanned_ == '"' || *scanned_ == '[' || *scanned_ == '{' || *scanned_ == 't' ||
                                     *scanned_ == 'f' || *scanned_ == 'n' || *scanned_ == ']' || *scanned_ == '}';
            if (!ends_itself && (last == ',' || last == ']' || last == '}' || last == '/' ||
                                 std::isspace(static_cast<unsigned char>(last))))
                --end;
        }
        scan_to(end);
    }

    std::string_view text_;
    std::string file_;
    char const* scanned_;
    int line_ = 1, column_ = 1;
    std::vector<JsonValue*> open_;
};

}  // namespace

std::string JsonValue::described() const {
    struct Describe {
        std::string operator()(std::nullptr_t) const { return "null"; }
        std::string operator()(bool b) const { return b ? "true" : "false"; }
        std::string operator()(double x) const { return fmt::format("the number {}", x); }
        std::string operator()(std::string const& s) const { return fmt::format("the string \"{}\"", s.substr(0, 60)); }
        std::string operator()(JsonArray const& a) const { return fmt::format("an array of {}", a.size()); }
        std::string operator()(JsonObject const&) const { return "an object"; }
    };
    return std::visit(Describe{}, value);
}

JsonValue parse_json(std::string_view text, std::string const& file_name) {
    TreeBuilder builder(text, file_name);
    if (text.find_first_not_of(" \t\r\n") == std::string_view::npos) builder.fail({0, 0}, "the file is empty");
    builder.consumed = text.data();
    CountingIterator const begin{text.data(), &builder.consumed}, end{text.data() + text.size(), nullptr};
    constexpr bool whole_input = true, comments = true;
    Library::sax_parse(begin, end, &builder, nlohmann::detail::input_format_t::json, whole_input, comments);
    return std::move(builder.root);
}

JsonValue read_json(std::filesystem::path const& path) {
    auto const fail = [&](std::string const& message) { throw InputError(Diagnostic{{path.string()}, "", message}); };
    std::error_code error;
    auto const status = std::filesystem::status(path, error);
    if (!std::filesystem::exists(status)) fail("no such file");
    if (!std::filesystem::is_regular_file(status)) fail("is not a regular file");
    std::uintmax_t const size = std::filesystem::file_size(path, error);
    if (size > largest_file) fail(fmt::format("has {} MiB, allowed: at most {} MiB", size >> 20, largest_file >> 20));
    std::ifstream in(path, std::ios::binary);
    if (!in) fail("cannot be read");
    std::string const text((std::istreambuf_iterator<char>(in)), {});
    return parse_json(text, path.string());
}

}  // namespace iride
