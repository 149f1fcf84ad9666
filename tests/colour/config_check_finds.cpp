// SPDX-License-Identifier: Apache-2.0
// A config that is wrong in one place is found wrong, there and nowhere else.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <regex>
#include <sstream>

#include "colour/config_check.h"
#include "colour/reference_space.h"
#include "support/files.h"
#include "support/scenes.h"

using namespace iride;
using Catch::Matchers::Contains;

namespace {

std::string shipped_text() { return test::content(std::filesystem::path(IRIDE_SOURCE_DIR) / "data/ocio/config.ocio"); }

// The text with `what` replaced by `with` once, behind the place where the space's definition begins.
std::string edited(std::string const& space, std::string const& what, std::string const& with) {
    std::string text = shipped_text();
    std::size_t const at = text.find(what, text.find("    name: " + space + "\n"));
    REQUIRE(at != std::string::npos);
    return text.replace(at, what.size(), with);
}

using Numbers = std::vector<double>;  // 16, by rows

Numbers matrix_of(std::string const& text, std::string const& space) {
    std::size_t const at = text.find("matrix: [", text.find("    name: " + space + "\n")) + 9;
    std::string list = text.substr(at, text.find(']', at) - at);
    std::ranges::replace(list, ',', ' ');
    std::istringstream in(list);
    Numbers numbers;
    for (double n; in >> n;) numbers.push_back(n);
    return numbers;
}

std::string with_matrix(std::string const& space, Numbers const& numbers) {
    std::string text = shipped_text();
    std::size_t const at = text.find("matrix: [", text.find("    name: " + space + "\n")) + 9;
    return text.replace(at, text.find(']', at) - at, fmt::format("{:.17g}", fmt::join(numbers, ", ")));
}

std::vector<std::string> wrong_spaces(std::string const& text) {
    test::TemporaryFolder const folder;
    ConfigCheck const check = check_config(ColourConfig(folder.write("config.ocio", text)));
    std::vector<std::string> names;
    for (SpaceCheck const& space : check.spaces)
        if (!space.ok) names.push_back(space.name);
    CHECK(check.ok == names.empty());
    return names;
}

using Names = std::vector<std::string>;

}  // namespace

TEST_CASE("the shipped config is right in every space it has", "[law]") {
    CHECK(wrong_spaces(shipped_text()) == Names{});
    ConfigCheck const check =
        check_config(ColourConfig(std::filesystem::path(IRIDE_SOURCE_DIR) / "data/ocio/config.ocio"));
    CHECK(check.spaces.size() == 31);
    REQUIRE(check.unchecked.size() == 1);
    CHECK(check.unchecked[0].name == "Raw");
    for (SpaceCheck const& space : check.spaces) {
        INFO(space.name);
        CHECK(space.white_error < 1e-6);
        CHECK(space.negative != "not finite");
    }
}

TEST_CASE("a wrong digit of a matrix is found", "[law]") {
    Numbers m = matrix_of(shipped_text(), "Linear Rec.709 (sRGB)");
    m[1] += 1e-4;
    CHECK(wrong_spaces(with_matrix("Linear Rec.709 (sRGB)", m)) == Names{"Linear Rec.709 (sRGB)"});
    m = matrix_of(shipped_text(), "CIE Lab (D50)");
    m[6] += 1e-4;
    CHECK(wrong_spaces(with_matrix("CIE Lab (D50)", m)) == Names{"CIE Lab (D50)"});
}

TEST_CASE("a matrix of four digits is found", "[law]") {
    Numbers m = matrix_of(shipped_text(), "Linear P3-D65");
    for (double& n : m) n = std::round(n * 1e4) / 1e4;
    CHECK(wrong_spaces(with_matrix("Linear P3-D65", m)) == Names{"Linear P3-D65"});
}

TEST_CASE("a wrong gamma is found", "[law]") {
    CHECK(wrong_spaces(edited("sRGB - Texture", "gamma: 2.4", "gamma: 2.2")) == Names{"sRGB - Texture"});
    CHECK(wrong_spaces(edited("AdobeRGB - Texture", "value: 2.19921875", "value: 2.2")) == Names{"AdobeRGB - Texture"});
    CHECK(wrong_spaces(edited("CIE Luv (E)", "offset: [0, 0, 0.16, 0]", "offset: [0, 0, 0.161, 0]")) ==
          Names{"CIE Luv (E)"});
}

TEST_CASE("swapped primaries are found", "[law]") {
    Numbers m = matrix_of(shipped_text(), "Linear Rec.2020");
    for (std::size_t i = 0; i < 4; ++i) std::swap(m[i], m[4 + i]);
    CHECK(wrong_spaces(with_matrix("Linear Rec.2020", m)) == Names{"Linear Rec.2020"});
    CHECK(wrong_spaces(with_matrix("Display P3", matrix_of(shipped_text(), "Linear Rec.2020"))) == Names{"Display P3"});
}

TEST_CASE("a wrong white is found", "[law]") {
    CHECK(wrong_spaces(with_matrix("CIE XYZ (D50)", matrix_of(shipped_text(), "CIE XYZ (D65)"))) ==
          Names{"CIE XYZ (D50)"});
    // Linear Rec.709 without adaptation: (1,1,1) of ACES is no longer white there.
    MatrixDouble const m = rgb::rec709.from_xyz_matrix() * rgb::aces2065_1.to_xyz_matrix();
    CHECK(wrong_spaces(with_matrix("Linear Rec.709 (sRGB)", {m(0, 0), m(0, 1), m(0, 2), 0, m(1, 0), m(1, 1), m(1, 2), 0,
                                                             m(2, 0), m(2, 1), m(2, 2), 0, 0, 0, 0, 1})) ==
          Names{"Linear Rec.709 (sRGB)"});
}

TEST_CASE("a space that overflows or has no way back is found", "[law]") {
    constexpr double beyond_float = 1e39;  // not finite in float, and NaN when multiplied by 0
    Numbers huge(16, 0.0);
    for (std::size_t i = 0; i < 16; i += 5) huge[i] = beyond_float;
    CHECK(wrong_spaces(with_matrix("Linear AdobeRGB", huge)) == Names{"Linear AdobeRGB"});
    CHECK(wrong_spaces(with_matrix("Linear AdobeRGB", Numbers(16, 1.0))) == Names{"Linear AdobeRGB"});
}

TEST_CASE("a role that names another space is found by all that follows from it", "[law]") {
    CHECK(wrong_spaces(std::regex_replace(shipped_text(), std::regex("aces_interchange: ACES2065-1"),
                                          "aces_interchange: ACEScg"))
              .size() > 20);
}

TEST_CASE("spaces are recognised by alias and interop identifier", "[unit]") {
    for (char const* name : {"ACES2065-1", "ACES - ACEScg", "lin_ap1_scene", "lin_rec709", "Linear Rec.709 (sRGB)",
                             "Utility - Linear - sRGB", "lin_p3d65_scene", "lin_ciexyzd65_scene", "srgb_tx"}) {
        INFO(name);
        CHECK(find_reference_space({"whatever", name}, false));
        CHECK_FALSE(find_reference_space({"whatever"}, false));
    }
    CHECK(find_reference_space({"Rec.2100-HLG - Display"}, true));
    CHECK_FALSE(find_reference_space({"sRGB - Texture"}, true));
}

TEST_CASE("a config that cannot be checked says why", "[input]") {
    test::TemporaryFolder const folder;
    auto const message = [&](std::string const& text) -> std::string {
        try {
            check_config(ColourConfig(folder.write("bad.ocio", text)));
        } catch (InputError const& e) {
            return e.what();
        }
        return "accepted";
    };
    CHECK_THAT(message(""), Contains("bad.ocio: OpenColorIO refuses this config"));
    CHECK_THAT(message("not: [a, config"), Contains("OpenColorIO refuses this config"));
    CHECK_THAT(message(edited("ACEScg", "ACEScg_to_ACES2065-1", "ACEScg_to_nowhere")), Contains("nowhere"));
    CHECK_THAT(message(std::regex_replace(shipped_text(), std::regex("  aces_interchange: ACES2065-1\n"), "")),
               Contains("bad.ocio: roles: the role aces_interchange is missing"));
    CHECK_THROWS_WITH(ColourConfig(folder.path() / "none.ocio"), Contains("no such OpenColorIO config"));
    CHECK_THROWS_WITH(ColourConfig(folder.path()), Contains("no such OpenColorIO config"));
    CHECK_THROWS_WITH(ColourConfig().between("ACEScg", "CIE Lub (D65)"), Contains("did you mean 'CIE Lu"));
}
