// SPDX-License-Identifier: Apache-2.0
#include "base/json.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <unordered_set>

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

// The library quotes what it has read last, which may be a string of megabytes: the middle is left out.
std::string shortened(std::string const& message) {
    constexpr std::size_t longest = 240, head = 160, tail = 60;
    if (message.size() <= longest) return message;
    return message.substr(0, head) + " ... " + message.substr(message.size() - tail);
}

// Builds the tree from the library's events. An event comes as soon as its token has been read; a number's alone comes
// one character late, since only the next one ends it. Between tokens stand white space, comments, ',' and ':'.
class TreeBuilder : public nlohmann::json_sax<Library> {
  public:
    TreeBuilder(std::string_view text, std::string file) : text_(text), file_(std::move(file)), scanned_(text.data()) {
        constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
        if (text.starts_with(byte_order_mark)) scanned_ += byte_order_mark.size();
    }

    char const* consumed = nullptr;  // end of what the library has read
    JsonValue root;

    bool null() override { return put(nullptr, consumed); }
    bool boolean(bool b) override { return put(b, consumed); }
    bool number_integer(number_integer_t n) override { return put_number(static_cast<double>(n)); }
    bool number_unsigned(number_unsigned_t n) override { return put_number(static_cast<double>(n)); }
    bool number_float(number_float_t n, string_t const&) override { return put_number(static_cast<double>(n)); }
    bool string(string_t& s) override { return put(std::move(s), consumed); }
    bool binary(binary_t&) override { return false; }  // no token of JSON's text form
    bool start_object(std::size_t) override { return open(JsonObject{}); }
    bool start_array(std::size_t) override { return open(JsonArray{}); }
    bool end_object() override { return close(); }
    bool end_array() override { return close(); }
    bool key(string_t& name) override {
        Position const where = next_token();
        if (!open_.back().keys.insert(name).second) fail(where, fmt::format("the key '{}' is there twice", name));
        std::get<JsonObject>(open_.back().value->value).emplace_back(name, JsonValue{});
        scan_to(consumed);
        return true;
    }
    bool parse_error(std::size_t position, std::string const& token, nlohmann::detail::exception const& e) override {
        constexpr int number_overflow = 406;
        if (e.id == number_overflow)
            fail(next_token(), shortened("the number " + token + " is too large for a double"));
        // "[json.exception.parse_error.101] parse error at line 1, column 2: syntax error while ...; expected ..."
        std::string const message = e.what();
        std::size_t const colon = message.find(": ");
        scan_to(text_.data() + std::min(position > 0 ? position - 1 : 0, text_.size()));
        fail({line_, column_}, shortened(colon == std::string::npos ? message : message.substr(colon + 2)));
    }

    [[noreturn]] void fail(Position where, std::string const& message) const {
        throw InputError({file_, where.line, where.column}, "", message);
    }

  private:
    using Value = decltype(JsonValue::value);
    struct Open {
        JsonValue* value;  // stays good: a container grows only while it is the innermost
        std::unordered_set<std::string> keys;
    };

    bool put(Value value, char const* token_end) {
        Position const where = next_token();
        slot() = JsonValue{std::move(value), where.line, where.column};
        scan_to(token_end);
        return true;
    }
    bool put_number(double number) {
        next_token();
        std::string_view const rest(scanned_, static_cast<std::size_t>(text_.data() + text_.size() - scanned_));
        return put(number, scanned_ + std::min(rest.find_first_not_of("+-.0123456789eE"), rest.size()));
    }
    bool open(Value container) {
        Position const where = next_token();
        if (open_.size() >= deepest) fail(where, fmt::format("nested deeper than {} levels", deepest));
        JsonValue& here = slot();
        here = JsonValue{std::move(container), where.line, where.column};
        open_.push_back({&here, {}});
        scan_to(consumed);
        return true;
    }
    bool close() {
        open_.pop_back();
        scan_to(consumed);
        return true;
    }
    // Where the next value goes.
    JsonValue& slot() {
        if (open_.empty()) return root;
        if (JsonArray* array = std::get_if<JsonArray>(&open_.back().value->value)) return array->emplace_back();
        return std::get<JsonObject>(open_.back().value->value).back().second;
    }

    // Go on to the first character of the token that has just been read, and tell its place.
    Position next_token() {
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
    // Columns count characters: the continuation bytes 10xxxxxx of UTF-8 do not.
    void scan_to(char const* to) {
        for (; scanned_ < to; ++scanned_) {
            if (*scanned_ == '\n')
                ++line_, column_ = 1;
            else if ((static_cast<unsigned char>(*scanned_) & 0xC0) != 0x80)
                ++column_;
        }
    }

    std::string_view text_;
    std::string file_;
    char const* scanned_;  // the character that line_ and column_ are those of
    int line_ = 1, column_ = 1;
    std::vector<Open> open_;
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
    auto const fail = [&](std::string const& message) { throw InputError({path.string()}, "", message); };
    std::error_code error;
    auto const status = std::filesystem::status(path, error);
    if (!std::filesystem::exists(status)) fail("no such file");
    if (!std::filesystem::is_regular_file(status)) fail("is not a regular file");
    std::uintmax_t const size = std::filesystem::file_size(path, error);
    if (error) fail("cannot be read: " + error.message());
    if (size > largest_file) fail(fmt::format("has {} MiB, allowed: at most {} MiB", size >> 20, largest_file >> 20));
    std::ifstream in(path, std::ios::binary);
    if (!in) fail("cannot be read");
    std::string const text((std::istreambuf_iterator<char>(in)), {});
    return parse_json(text, path.string());
}

}  // namespace iride
