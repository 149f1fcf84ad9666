// SPDX-License-Identifier: Apache-2.0
// The table of known spaces: their names in ACES and other configs, and the identifiers of the colour interop forum.
#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <cctype>

#include "colour/reference_space.h"

namespace iride {

namespace {

using Names = std::vector<std::string>;

MatrixDouble from_aces_to_xyz(Chromaticity const& white) {
    return bradford_adaptation(rgb::aces2065_1.white, white) * rgb::aces2065_1.to_xyz_matrix();
}
MatrixDouble from_aces(RgbSpace const& space) { return space.from_xyz_matrix() * from_aces_to_xyz(space.white); }

void add_scene(std::vector<ReferenceSpace>& all) {
    auto const add = [&](char const* name, Names const& names, MatrixDouble const& matrix, SpaceCurve curve) {
        all.push_back({name, names, false, matrix, curve});
    };
    // ACES: the adaptation between equal whites would only add rounding.
    add("ACES2065-1", {"aces20651", "acesaces20651", "linap0", "linap0scene"}, MatrixDouble::Identity(),
        SpaceCurve::none);
    MatrixDouble const ap1 = rgb::acescg.from_xyz_matrix() * rgb::aces2065_1.to_xyz_matrix();
    add("ACEScg", {"acescg", "acesacescg", "linap1", "linap1scene"}, ap1, SpaceCurve::none);
    add("ACEScc", {"acescc", "acesacescc", "acesccap1scene"}, ap1, SpaceCurve::acescc);
    add("ACEScct", {"acescct", "acesacescct", "acescctap1", "acescctap1scene"}, ap1, SpaceCurve::acescct);
    struct Linear {
        RgbSpace const* space;
        char const* name;
        Names keys;
    };
    for (Linear const& l : {Linear{&rgb::rec709, "linear Rec.709", {"rec709", "srgb", "rec709srgb", "bt709"}},
                            Linear{&rgb::rec2020, "linear Rec.2020", {"rec2020", "bt2020"}},
                            Linear{&rgb::display_p3, "linear P3-D65", {"p3d65", "displayp3"}},
                            Linear{&rgb::adobe_rgb, "linear Adobe RGB", {"adobergb", "adobergb1998"}}}) {
        Names names;
        for (std::string const& key : l.keys)
            for (char const* form : {"lin{}", "linear{}", "lin{}scene", "scenelinear{}", "{}linear", "utilitylinear{}"})
                names.push_back(fmt::format(fmt::runtime(form), key));
        add(l.name, names, from_aces(*l.space), SpaceCurve::none);
    }
    add("sRGB texture", {"srgbtexture", "srgbtx", "srgbrec709scene", "utilitysrgbtexture", "srgbencodedrec709srgb"},
        from_aces(rgb::rec709), SpaceCurve::srgb);
    add("Display P3 texture", {"displayp3texture", "p3d65tx", "srgbp3d65scene", "srgbencodedp3d65"},
        from_aces(rgb::display_p3), SpaceCurve::srgb);
    add("Adobe RGB texture", {"adobergbtexture", "adobergbtx", "g22adobergbscene"}, from_aces(rgb::adobe_rgb),
        SpaceCurve::adobe);
    add("gamma 2.2 Rec.709 texture", {"gamma22rec709texture", "g22rec709", "g22rec709scene", "gamma22encodedrec709"},
        from_aces(rgb::rec709), SpaceCurve::gamma22);
    add("Rec.2020 camera", {"camerarec2020", "rec2020camera", "utilityrec2020camera"}, from_aces(rgb::rec2020),
        SpaceCurve::rec2020);
}

void add_cie(std::vector<ReferenceSpace>& all) {
    for (char const* white : {"D65", "D50", "E"}) {
        Chromaticity const w = named_white(white);
        auto const add = [&](char const* short_name, SpaceCurve curve, Names names) {
            names.push_back(fmt::format("cie{}{}", short_name, white));
            for (std::string& name : names) name = space_key(name);
            all.push_back(
                {fmt::format("CIE {} {}", short_name, white), names, false, from_aces_to_xyz(w), curve, to_xyz(w, 1)});
        };
        Names const xyz{fmt::format("ciexyz{}scene", white), fmt::format("linciexyz{}scene", white),
                        fmt::format("ciexyz{}scenereferred", white)};
        add("XYZ", SpaceCurve::none, xyz);
        add("uvY", SpaceCurve::uvY, {});
        add("Luv", SpaceCurve::Luv, {});
        add("Lab", SpaceCurve::Lab, {});
    }
    all.push_back({"CIE XYZ of the ACES white",
                   {"utilityxyzd60", "xyzd60", "ciexyzd60", "ciexyzd60scene"},
                   false,
                   rgb::aces2065_1.to_xyz_matrix()});
}

void add_display(std::vector<ReferenceSpace>& all) {
    auto const add = [&](char const* name, Names names, MatrixDouble const& matrix, SpaceCurve curve) {
        Names const bare = names;
        for (std::string const& n : bare) names.push_back(n + "display");
        all.push_back({name, names, true, matrix, curve});
    };
    MatrixDouble const rec709 = rgb::rec709.from_xyz_matrix(), rec2020 = rgb::rec2020.from_xyz_matrix(),
                       p3 = rgb::display_p3.from_xyz_matrix();
    add("CIE XYZ of a D65 display", {"ciexyzd65", "linciexyzd65"}, MatrixDouble::Identity(), SpaceCurve::none);
    add("sRGB display", {"srgb", "srgbrec709"}, rec709, SpaceCurve::srgb);
    add("Display P3", {"displayp3", "srgbp3d65"}, p3, SpaceCurve::srgb);
    add("gamma 2.2 Rec.709 display", {"gamma22rec709", "g22rec709"}, rec709, SpaceCurve::gamma22);
    add("Rec.1886 Rec.709 display", {"rec1886rec709", "g24rec709"}, rec709, SpaceCurve::bt1886);
    add("Rec.1886 Rec.2020 display", {"rec1886rec2020", "g24rec2020"}, rec2020, SpaceCurve::bt1886);
    add("P3-D65 display", {"p3d65", "g26p3d65"}, p3, SpaceCurve::gamma26);
    add("Rec.2100 PQ display", {"rec2100pq", "pqrec2020"}, rec2020, SpaceCurve::pq);
    add("P3-D65 PQ display", {"st2084p3d65", "pqp3d65"}, p3, SpaceCurve::pq);
    add("Rec.2100 HLG display", {"rec2100hlg", "hlgrec2020", "rec2100hlg1000nit"}, rec2020, SpaceCurve::hlg);
}

}  // namespace

std::string space_key(std::string const& name) {
    std::string key;
    for (char const c : name)
        if (std::isalnum(static_cast<unsigned char>(c)))
            key += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return key;
}

std::vector<ReferenceSpace> const& reference_spaces() {
    static std::vector<ReferenceSpace> const all = [] {
        std::vector<ReferenceSpace> spaces;
        add_scene(spaces);
        add_cie(spaces);
        add_display(spaces);
        return spaces;
    }();
    return all;
}

ReferenceSpace const* find_reference_space(std::vector<std::string> const& names, bool display_referred) {
    for (std::string const& name : names)
        for (ReferenceSpace const& space : reference_spaces())
            if (space.display_referred == display_referred &&
                std::ranges::find(space.keys, space_key(name)) != space.keys.end())
                return &space;
    return nullptr;
}

}  // namespace iride
