// SPDX-License-Identifier: Apache-2.0
// Prints docs/radiosity.md and draws its pictures (scripts/radiosity runs it): radiosity_page COST.json ERROR.json
// FOLDER. COST.json: what runs of `iride radiosity` took; ERROR.json: what `iride bench error` measured.
#include <fmt/format.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "app/palette.h"
#include "bench/measure/scene_text.h"
#include "film/preview.h"
#include "integrators/radiosity/closed_forms.h"
#include "integrators/radiosity/radiosity.h"
#include "integrators/render.h"

namespace iride {

namespace {

using namespace radiosity;
using Json = nlohmann::json;

// ---------------------------------------------------------------------------------------------------------------------
// Form factors between whole shapes, which are cut into patches: A F = sum over the patches of both.

struct Exchange {
    std::string what;
    std::string scene;
    int from, to;  // shapes
    double exact;
};

std::string scene_of(std::string const& shapes) {
    return R"({"camera":{"eye":[0,0,9],"target":[0,0,0],"field_deg":30},
        "materials":{"m":{"type":"diffuse","reflectance":0.5}},"shapes":[)" +
           shapes + "]}";
}

// Ceiling, floor, x = 0, x = l, z = w, z = 0 of a box of height h; all look inwards.
std::string box(double l, double w, double h) {
    std::string shapes;
    for (std::string const& corners : {fmt::format("[[0,{2},0],[{0},{2},0],[{0},{2},{1}],[0,{2},{1}]]", l, w, h),
                                       fmt::format("[[0,0,0],[0,0,{1}],[{0},0,{1}],[{0},0,0]]", l, w),
                                       fmt::format("[[0,0,0],[0,{1},0],[0,{1},{0}],[0,0,{0}]]", w, h),
                                       fmt::format("[[{0},0,0],[{0},0,{1}],[{0},{2},{1}],[{0},{2},0]]", l, w, h),
                                       fmt::format("[[0,0,{1}],[0,{2},{1}],[{0},{2},{1}],[{0},0,{1}]]", l, w, h),
                                       fmt::format("[[0,0,0],[{0},0,0],[{0},{1},0],[0,{1},0]]", l, h)})
        shapes += fmt::format(R"({}{{"type":"quad","material":"m","corners":{}}})", shapes.empty() ? "" : ",", corners);
    return scene_of(shapes);
}

std::vector<Exchange> exchanges() {
    std::string const cube = box(1, 1, 1), low = box(2, 2, 1),
                      discs = scene_of(
                          R"({"type":"disc","material":"m","centre":[0,0,0],"normal":[0,0,1],"radius":1},
                             {"type":"disc","material":"m","centre":[0,0,2],"normal":[0,0,-1],"radius":1})"),
                      ball = scene_of(R"({"type":"sphere","centre":[0,0,0],"radius":1,"material":"m","flip":true})");
    return {{"cube, opposite faces", cube, 0, 1, opposite_rectangles(1, 1, 1)},
            {"cube, adjacent faces", cube, 1, 2, adjacent_rectangles(1, 1, 1)},
            {"2 x 2 x 1 box, floor to ceiling", low, 1, 0, opposite_rectangles(2, 2, 1)},
            {"2 x 2 x 1 box, floor to wall", low, 1, 2, adjacent_rectangles(2, 1, 2)},
            {"2 x 2 x 1 box, wall to next wall", low, 2, 4, adjacent_rectangles(2, 2, 1)},
            {"coaxial discs, distance 2 radii", discs, 0, 1, coaxial_discs(1, 1, 2)},
            {"inside of a sphere, to itself", ball, 0, 0, 1}};
}

// The error of the exchange between whole shapes, relative.
double error_of(Exchange const& e, FormFactorMethod const& method) {
    auto const scene = bench::scene_from(e.scene);
    PatchMesh const mesh = make_patches(*scene, .25);
    PatchTracer const tracer(mesh);
    FormFactors const F = method.compute(mesh, tracer, method.fineness);
    double area = 0, exchanged = 0;
    for (std::size_t i = 0; i < mesh.patch.size(); ++i) {
        if (mesh.patch[i].shape != e.from || mesh.patch[i].back) continue;
        area += mesh.patch[i].area;
        for (FormFactors::InnerIterator f(F, static_cast<Eigen::Index>(i)); f; ++f)
            if (mesh.patch[static_cast<std::size_t>(f.col())].shape == e.to)
                exchanged += mesh.patch[i].area * f.value();
    }
    return std::abs(exchanged / area - e.exact) / e.exact;
}

void print_closed_forms() {
    fmt::print(
        "## Form factors against closed forms\n\n"
        "Shapes cut into patches of at most .25 (round ones become facets: their error is the facets'), the patches' "
        "factors\n"
        "added up to those of the whole shapes: relative error, each method at its default fineness.\n\n"
        "| pair | F |");
    std::string rule = "|---|---|";
    for (FormFactorMethod const& m : form_factor_methods())
        if (m.compute) fmt::print(" {} |", m.name), rule += "---|";
    fmt::print("\n{}\n", rule);
    for (Exchange const& e : exchanges()) {
        fmt::print("| {} | {:.9f} |", e.what, e.exact);
        for (FormFactorMethod const& m : form_factor_methods())
            if (m.compute) fmt::print(" {:.1e} |", error_of(e, m));
        fmt::print("\n");
    }
}

// ---------------------------------------------------------------------------------------------------------------------

void print_solvers() {
    auto const scene = load_scene(find_scene("cube-ceiling"));
    SceneRadiosity const solution(*scene, visible_range, {.patches = 300, .wavelengths = 8, .fineness = 4096});
    System const& s = solution.system();
    Rates worst{0, 0};
    for (Eigen::Index w = 0; w < s.wavelengths(); ++w) {
        Rates const r = spectral_radii(s, w);
        worst = {std::max(worst.jacobi, r.jacobi), std::max(worst.gauss_seidel, r.gauss_seidel)};
    }
    fmt::print(
        "\n## Solvers\n\n"
        "`cube-ceiling` in {} patches, {} wavelengths at once: steps until the largest residual is 1e-6 of the "
        "largest\n"
        "emission, and the number that the spectral radius of the iteration (jacobi {:.4f}, gauss-seidel {:.4f}, of "
        "the\n"
        "wavelength where it is largest) foretells: log 1e-6 / log radius. Southwell and shooting take a patch a "
        "step,\n"
        "the others all.\n\n"
        "| solver | steps | foretold | residual |\n|---|---|---|---|\n",
        s.patches(), s.wavelengths(), worst.jacobi, worst.gauss_seidel);
    for (SolverEntry const& e : solvers()) {
        Solution const found = solve(s, e, {.iterations = 100000, .tolerance = 1e-6});
        double const radius = e.name == std::string("jacobi")         ? worst.jacobi
                              : e.name == std::string("gauss-seidel") ? worst.gauss_seidel
                                                                      : 0;
        fmt::print("| {} | {} | {} | {:.1e} |\n", e.name, found.iterations,
                   radius > 0 ? fmt::format("{:.1f}", std::log(1e-6) / std::log(radius)) : "-", found.residual);
    }
}

// ---------------------------------------------------------------------------------------------------------------------
// Progressive refinement: what has been shot and what has not, without and with the ambient share.

void draw(Scene const& scene, RenderPlan const& plan, SceneRadiosity const& solution, Spectra const& b,
          std::filesystem::path const& path) {
    Film film = make_film(scene);
    render(scene, plan, *show(solution.field_of(b)), {.spp = 16}, film);
    write_preview(film, scene.film.white, scene.film.exposure, ColourConfig("").to_display("", ""), path);
}

double relative_error(System const& s, Spectra const& b, Spectra const& exact) {
    return ((b - exact).abs().colwise() * s.area).sum() / (exact.abs().colwise() * s.area).sum();
}

void print_refinement(std::filesystem::path const& folder) {
    auto const scene = load_scene(find_scene("room"));
    constexpr int side = 128;
    scene->film.width = scene->film.height = side;
    RenderPlan const plan = make_plan(*scene);
    SceneRadiosity const solution(*scene, plan.wavelengths, {.patches = 4000, .wavelengths = 12});
    System s = solution.system();
    auto const southwell = std::ranges::find(solvers(), std::string("southwell"), [](SolverEntry const& e) {
                               return std::string(e.name);
                           })->make(s);
    fmt::print(
        "\n## Progressive refinement\n\n"
        "`room` in {} patches after so many shots, the patch with the most unshot power first: shot and unshot light, "
        "without\n"
        "and with the ambient share, and the error of both, over the area and relative. The last row is the "
        "solution.\n\n"
        "| shots | without | with | error without | with |\n|---|---|---|---|---|\n",
        s.patches());
    int done = 0;
    for (int shots : {1, 4, 30, 200, 2000}) {
        for (; done < shots; ++done) southwell->step();
        Spectra const b = southwell->radiosity(), unshot = residual(s, b), without = b + unshot,
                      with = without + s.reflectance.rowwise() * ambient(s, unshot.colwise() * s.area);
        std::array<std::string, 2> const names{fmt::format("shots-{}.png", shots),
                                               fmt::format("shots-{}-ambient.png", shots)};
        draw(*scene, plan, solution, without, folder / names[0]);
        draw(*scene, plan, solution, with, folder / names[1]);
        fmt::print("| {} | ![]({}/{}) | ![]({}/{}) | {:.3f} | {:.3f} |\n", shots, folder.filename().string(), names[0],
                   folder.filename().string(), names[1], relative_error(s, without, solution.radiosity()),
                   relative_error(s, with, solution.radiosity()));
    }
    draw(*scene, plan, solution, solution.radiosity(), folder / "solution.png");
    fmt::print("| all | ![]({0}/solution.png) | | 0 | 0 |\n", folder.filename().string());
}

// ---------------------------------------------------------------------------------------------------------------------

void print_cost(Json const& rows, std::filesystem::path const& folder) {
    fmt::print(
        "\n## Cost\n\n"
        "`room`, one wavelength and 40, by `iride radiosity` on {} threads: seconds of the whole program and the most "
        "memory it held.\n\n"
        "| form factors | patches | wavelengths | s | GB | links |\n|---|---|---|---|---|---|\n",
        rows["threads"].get<int>());
    struct Line {
        std::string name;
        std::vector<PlotPoint> seconds, bytes;
    };
    std::vector<Line> lines;
    for (Json const& r : rows["runs"]) {
        fmt::print("| {} | {} | {} | {:.3g} | {:.2g} | {} |\n", r["method"].get<std::string>(), r["patches"].get<int>(),
                   r["wavelengths"].get<int>(), r["seconds"].get<double>(), r["bytes"].get<double>() * 1e-9,
                   r["links"].is_null() ? "-" : std::to_string(r["links"].get<long>()));
        std::string const name = fmt::format("{}, {} nm", r["method"].get<std::string>(), r["wavelengths"].get<int>());
        auto line = std::ranges::find(lines, name, &Line::name);
        if (line == lines.end()) line = lines.insert(lines.end(), Line{name, {}, {}});
        double const x = std::log10(r["patches"].get<double>());
        line->seconds.push_back({x, std::log10(r["seconds"].get<double>())});
        line->bytes.push_back({x, std::log10(r["bytes"].get<double>() * 1e-9)});
    }
    PlotPage page(1560, 500);
    for (int panel = 0; panel < 2; ++panel) {
        Plot plot(420, 320, {3, 5.7, 1, "log10 patches"},
                  panel == 0 ? PlotAxis{-1, 3, 1, "log10 (time / s)"} : PlotAxis{-2, 1, 1, "log10 (memory / GB)"},
                  panel == 0 ? 30 : 370);
        for (std::size_t k = 0; k < lines.size(); ++k) {
            auto const& points = panel == 0 ? lines[k].seconds : lines[k].bytes;
            Stroke const stroke{line_palette[k % line_palette.size()], 2.5, false, lines[k].name};
            plot.line(points, stroke);
            for (PlotPoint const& p : points) plot.disc(p, 4, stroke.colour);
        }
        if (panel == 1) plot.legend();
        page.place(plot, panel * 600, 0);
    }
    page.write(folder / "cost.png");
    fmt::print("\n![Time and memory over the number of patches]({}/cost.png)\n", folder.filename().string());
}

std::string figure(Json const& v) { return v.is_null() ? "-" : fmt::format("{:.3g}", v.get<double>()); }

void print_errors(Json const& rows, std::filesystem::path const& folder) {
    fmt::print(
        "\n## Error against time\n\n"
        "256 x 256 pixels; `radiosity` at its default of about 2500 patches, and with 10000 that show what came to "
        "them "
        "from no lamp\n"
        "while lamps are sampled, without and with a last gather; `path`; and `two-pass`, which is path tracing with "
        "the "
        "radiosity as\n"
        "control variate. relMSE against a converged picture, without its own, which is the last column; 1e-4 is a "
        "root "
        "mean square\n"
        "of 1 %. ~: extrapolated along the slope of log relMSE over log time of sampling.\n\n"
        "![relMSE over time]({}/error.png)\n\n"
        "| scene | integrator | s before the first sample | s to relMSE 1e-2 | 1e-3 | 1e-4 | s to CIEDE2000 1 "
        "| least relMSE | reference |\n"
        "|---|---|---|---|---|---|---|---|---|\n",
        folder.filename().string());
    for (Json const& r : rows["error"])
        fmt::print("| {} | {} | {} | {} | {} | {}{} | {} | {} | {} |\n", r["scene"].get<std::string>(),
                   r["integrator"].get<std::string>(), figure(r["setup_seconds"]), figure(r["s_to_relmse_1e-2"]),
                   figure(r["s_to_relmse_1e-3"]),
                   r["extrapolated_1e-4"].get<bool>() && !r["s_to_relmse_1e-4"].is_null() ? "~" : "",
                   figure(r["s_to_relmse_1e-4"]), figure(r["s_to_delta_e_1"]), figure(r["relmse"]),
                   figure(r["reference_relmse"]));
}

void print_equations() {
    fmt::print(
        "# Radiosity\n\n"
        "Written by `scripts/radiosity`, which measures everything here anew. How it is called: README.md; what an "
        "integrator can\n"
        "be asked: docs/scene-format.md; why it is built as it is: docs/architecture.md.\n\n"
        "## Equations\n\n"
        "n patches of area A, at every wavelength of reflectance rho, emitting e, of radiosity b (W m^-2 nm^-1); F_ij "
        "is the share of\n"
        "what leaves i that arrives at j.\n\n"
        "| what | equation | source |\n|---|---|---|\n"
        "| radiosity | b_i = e_i + rho_i sum_j F_ij b_j | Goral 1984 |\n"
        "| form factor | F_ij = 1/A_i integral over i and j of cos cos / (pi r^2) V; A_i F_ij = A_j F_ji | Cohen 1993 "
        "|\n"
        "| polygons | A_1 F_12 = 1/(2 pi) double contour integral of ln r dx . dy | Goral 1984, Schröder 1993 |\n"
        "| hemicube | dA / (pi (1 + x^2 + y^2)^2), z dA / (pi (1 + y^2 + z^2)^2) at the sides | Cohen 1985 |\n"
        "| global lines | F_ij = lines that leave i and meet j / lines that leave i | Sbert 1993 |\n"
        "| links | of groups of patches, where G max(rho_r b_s, rho_s b_r) (R_r + R_s) / d <= tolerance | Hanrahan "
        "1991 |\n"
        "| shooting | b + unshot / A + rho sum unshot / (A (1 - mean rho)) | Cohen 1988 |\n"
        "| by chance | walks, and increments by local and global lines | Sbert 1997, Bekaert 1999 |\n"
        "| elements | F_ij = sum_s A_s F_sj / A_i: receivers split, senders stay | Cohen 1986 |\n"
        "| mirrors | F_ij(lambda): chains of reflections traced by rays | Sillion 1989 |\n"
        "| rough surfaces | L_ij = Le_ij + sum_k f_i(k, j) pi F_ik L_ki | Immel 1986, Aupperle 1993 |\n"
        "| last gather | b_v = rho_i / N sum of b_j over N rays from a vertex, elements split where it is not linear "
        "| Reichert 1992, Ward 1988 |\n"
        "| two passes | integral of f cos L = that of the solution + that of the difference along few paths | Wallace "
        "1987, "
        "Lafortune 1994 |\n\n");
}

Json read(char const* path) {
    std::ifstream in(path);
    return Json::parse(in);
}

}  // namespace

}  // namespace iride

int main(int count, char** words) {
    if (count != 4) {
        fmt::print(stderr, "radiosity_page COST.json ERROR.json FOLDER\n");
        return 2;
    }
    std::filesystem::path const folder = words[3];
    iride::print_equations();
    iride::print_closed_forms();
    iride::print_solvers();
    iride::print_refinement(folder);
    iride::print_cost(iride::read(words[1]), folder);
    iride::print_errors(iride::read(words[2]), folder);
}
