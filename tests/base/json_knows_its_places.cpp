// SPDX-License-Identifier: Apache-2.0
// JSON with places [RFC 8259]: line and column count characters from 1; every error is one line "file:line:column:
// ...".
#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <random>

#include "base/json.h"
#include "support/scenes.h"

using namespace iride;
using Catch::Matchers::Contains;
using Catch::Matchers::Equals;

namespace {

std::string error_of(std::string const& text) {
    try {
        parse_json(text, "a.json");
    } catch (InputError const& e) {
        return e.what();
    }
    return "no error";
}

JsonValue const& member(JsonValue const& object, std::string const& key) {
    for (auto const& [name, value] : *object.as<JsonObject>())
        if (name == key) return value;
    throw std::out_of_range(key);
}

// Walks a tree whose numbers are 1000 line + column of their own first character.
void check_numbers(JsonValue const& value, int& found) {
    if (auto const* number = value.as<double>()) {
        CHECK(*number == 1000 * value.line + value.column);
        ++found;
    }
    if (auto const* array = value.as<JsonArray>())
        for (JsonValue const& entry : *array) check_numbers(entry, found);
    if (auto const* object = value.as<JsonObject>())
        for (auto const& [name, entry] : *object) check_numbers(entry, found);
}

// Writes a random tree of such numbers with random white space and comments between all tokens.
class RandomText {
  public:
    explicit RandomText(unsigned seed) : random_(seed) {}
    std::string text;
    int numbers = 0;

    void value(int depth) {
        auto const kind = depth > 5 ? 0 : random_() % 4;
        if (kind == 0) {
            put(std::to_string(1000 * line_ + column_));
            ++numbers;
        } else if (kind == 1) {
            put("\"\xC3\xA9\\\"{ \"");  // a character of two bytes, an escaped quote, a bracket
        } else {
            bool const object = kind == 2;
            put(object ? "{" : "[");
            for (auto i = 0ul, n = random_() % 4; i < n; ++i) {
                space();
                if (i > 0) put(","), space();
                if (object) put(fmt::format("\"{}\"", i)), space(), put(":"), space();
                value(depth + 1);
            }
            space();
            put(object ? "}" : "]");
        }
    }
    void space() {
        static char const* const choices[] = {"", "", " ", "\n", "\t", " // , ] }\n", "/* 1:\n * ] */", "\r\n"};
        for (auto n = random_() % 3; n > 0; --n) put(choices[random_() % std::size(choices)]);
    }

  private:
    void put(std::string const& s) {
        text += s;
        for (unsigned char c : s) {
            if (c == '\n')
                ++line_, column_ = 1;
            else if (c < 0x80 || c >= 0xC0)
                ++column_;
        }
    }
    std::mt19937 random_;
    int line_ = 1, column_ = 1;
};

}  // namespace

// Fails for a parser that steps back one character at every bracket (as an earlier one did).
TEST_CASE("every value knows the line and column of its first character", "[unit]") {
    JsonValue const root =
        parse_json("{ // a\n  \"shapes\": [\n    { \"x\": 1\n    },\n    { \"y\": \"s\" }, true ]\n}", "f");
    JsonArray const& shapes = *member(root, "shapes").as<JsonArray>();
    auto const stands_at = [](JsonValue const& v, int line, int column) {
        CHECK(v.line == line);
        CHECK(v.column == column);
    };
    stands_at(root, 1, 1);
    stands_at(member(root, "shapes"), 2, 13);
    stands_at(shapes[0], 3, 5);
    stands_at(member(shapes[0], "x"), 3, 12);
    stands_at(shapes[1], 5, 5);
    stands_at(member(shapes[1], "y"), 5, 12);
    stands_at(shapes[2], 5, 19);
    CHECK(parse_json("\xEF\xBB\xBF 7", "f").column == 2);  // a byte order mark is no character
}

TEST_CASE("places are right whatever stands between the tokens", "[law]") {
    int numbers = 0;
    for (unsigned seed = 0; seed < 2000; ++seed) {
        RandomText random(seed);
        random.space();
        random.value(0);
        random.space();
        INFO(random.text);
        int found = 0;
        check_numbers(parse_json(random.text, "f"), found);
        CHECK(found == random.numbers);
        numbers += found;
    }
    CHECK(numbers > 500);
}

TEST_CASE("values arrive as written, keys in the file's order", "[unit]") {
    JsonValue const root =
        parse_json(R"({"z": [null, true, -2.5e-3, "\u00e9\n"], "a": {}, "b": [], "c": 9007199254740993})", "f");
    JsonObject const& object = *root.as<JsonObject>();
    CHECK(object[0].first == "z");
    CHECK(object[1].first == "a");
    JsonArray const& z = *object[0].second.as<JsonArray>();
    CHECK(z[0].as<std::nullptr_t>());
    CHECK(*z[1].as<bool>());
    CHECK(*z[2].as<double>() == -2.5e-3);
    CHECK(*z[3].as<std::string>() == "\xC3\xA9\n");
    CHECK(*object[3].second.as<double>() == 9007199254740992.0);  // nearest double of 2^53 + 1
    CHECK(z[1].described() == "true");
    CHECK(object[0].second.described() == "an array of 4");
}

TEST_CASE("what is no JSON is refused with its place and without the library's prefix", "[input]") {
    CHECK_THAT(error_of(""), Equals("a.json: the file is empty"));
    CHECK_THAT(error_of(" \n\t"), Equals("a.json: the file is empty"));
    CHECK_THAT(error_of("[1,\n 2,]"), Contains("a.json:2:4: syntax error") && Contains("unexpected ']'"));
    CHECK_THAT(error_of("[\xC3\xA9]"), Contains("a.json:1:2: syntax error"));
    CHECK_THAT(error_of("{\"a\":1,\n\"b\":2, \"a\":3}"), Equals("a.json:2:8: the key 'a' is there twice"));
    CHECK_THAT(error_of("[2, 1e400, 3]"), Equals("a.json:1:5: the number 1e400 is too large for a double"));
    CHECK_THAT(error_of("[-1e400]"), Contains("a.json:1:2: the number -1e400 is too large"));
    for (char const* text :
         {"[NaN]", "[Infinity]", "[-Infinity]", "nan", "[1 2]", "[1", "{\"a\"}", "{a: 1}", "'a'", "[.5]", "[+1]",
          "[01]", "[0x10]", "\"a", "/* open", "// only a comment", "1 1", "[\"\\x\"]", "[\"\xFF\"]"}) {
        INFO(text);
        CHECK_THAT(error_of(text), Contains("a.json:1:") && Contains("syntax error"));
        CHECK_THAT(error_of(text), !Contains("json.exception") && !Contains("parse error at"));
    }
    CHECK(error_of(fmt::format("[\"{}", std::string(1 << 20, 'x'))).size() <
          400);  // the text read last is not quoted whole
}

TEST_CASE("nesting deeper than 64 levels is refused", "[input]") {
    CHECK(error_of(std::string(64, '[') + std::string(64, ']')) == "no error");
    CHECK_THAT(error_of(std::string(65, '[') + std::string(65, ']')),
               Equals("a.json:1:65: nested deeper than 64 levels"));
    CHECK_THAT(error_of(std::string(1 << 20, '[')), Contains("nested deeper than 64 levels"));
}

TEST_CASE("an object of a hundred thousand keys is read in linear time", "[unit]") {
    std::string text = "{";
    for (int i = 0; i < 100000; ++i) text += "\"key " + std::to_string(i) + "\": 0,\n";
    JsonValue const root = parse_json(text + "\"last\": 1}", "f");  // minutes, were every key compared with every other
    CHECK(root.as<JsonObject>()->size() == 100001);
    CHECK(root.as<JsonObject>()->back().second.line == 100001);
}

TEST_CASE("a file that is missing, a folder or too large is refused unread", "[input]") {
    test::TemporaryFolder const folder;
    auto const error_reading = [](std::filesystem::path const& path) {
        try {
            read_json(path);
        } catch (InputError const& e) {
            return std::string(e.what());
        }
        return std::string("no error");
    };
    CHECK_THAT(error_reading(folder.path() / "none.json"), Contains("none.json: no such file"));
    CHECK_THAT(error_reading(folder.path()), Contains("is not a regular file"));
    auto const large = folder.write("large.json", "[1]");
    std::filesystem::resize_file(large, 2ull << 30);  // 2 GiB, sparse
    CHECK_THAT(error_reading(large), Contains("has 2048 MiB, allowed: at most 256 MiB"));
    CHECK_THAT(error_reading(folder.write("bad.json", "{\n!")), Contains("bad.json:2:1: syntax error"));
    CHECK(read_json(folder.write("good.json", "[1, 2]")).as<JsonArray>()->size() == 2);
}
