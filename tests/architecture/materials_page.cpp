// SPDX-License-Identifier: Apache-2.0
// docs/materials.md is complete: every type of material that a scene file may name, each with a picture that is there
// and that the script can make again.
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>

#include "scene/readers.h"
#include "support/files.h"

using namespace iride;

TEST_CASE("every type of material is shown in docs/materials.md", "[architecture]") {
    std::filesystem::path const root = IRIDE_SOURCE_DIR;
    std::string const page = test::content(root / "docs/materials.md");
    for (MaterialEntry const& entry : material_entries()) {
        INFO(entry.name);
        CHECK(page.find('"' + std::string(entry.name) + '"') != std::string::npos);
    }
    auto const made = nlohmann::json::parse(test::content(root / "scripts/material_pictures.json"));
    std::set<std::string> shown{"gold-by-angle"};
    std::regex const picture(R"(\]\(materials/([^)]+)\.png\))");
    for (std::sregex_iterator i(page.begin(), page.end(), picture), end; i != end; ++i) {
        std::string const name = (*i)[1];
        INFO(name);
        CHECK(std::filesystem::exists(root / "docs/materials" / (name + ".png")));
        CHECK((made.contains(name) || name == "gold-by-angle"));
        shown.insert(name);
    }
    for (auto const& [name, entry] : made.items()) {
        INFO(name);
        CHECK(shown.contains(name));
    }
}
