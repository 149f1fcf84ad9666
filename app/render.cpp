// SPDX-License-Identifier: Apache-2.0
// iride render SCENE: from a scene file to an EXR, a preview and a report.
#include <fmt/format.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <csignal>
#include <memory>
#include <mutex>
#include <nlohmann/json.hpp>
#include <thread>

#include "app/command.h"
#include "base/atomic_file.h"
#include "film/exr.h"
#include "film/preview.h"
#include "integrators/render.h"

namespace iride {

namespace {

struct Options {
    std::string scene, output, integrator, size, colourspace = "ACEScg", view, ocio, preview, report;
    int spp = 0, threads = 0;
    double seconds = 0, error = 0;
    std::int64_t seed = -1;
    bool quiet = false;
};

// Above this share of dropped samples the picture is not to be trusted (exit code 3).
constexpr double trustworthy_rejections = 1e-4;

std::atomic<bool> interrupted{false};
extern "C" void on_interrupt(int) {
    // A second Ctrl-C ends the program at once.
    if (interrupted.exchange(true)) std::_Exit(exit_interrupted);
}

[[noreturn]] void fail(std::string const& key, std::string const& message) { throw InputError({}, key, message); }

void apply_size(Scene& scene, std::string const& size) {
    if (size.empty()) return;
    int width = 0, height = 0, used = 0;
    if (std::sscanf(size.c_str(), "%dx%d%n", &width, &height, &used) != 2 || used != static_cast<int>(size.size()) ||
        width < 1 || height < 1 || width > 65536 || height > 65536)
        fail("--size", fmt::format("found '{}', allowed: WIDTHxHEIGHT, each 1 .. 65536, e.g. 640x360", size));
    scene.film.width = width;
    scene.film.height = height;
}

// One line on a terminal that is written over: percentage, time left.
class Progress {
  public:
    Progress(bool shown, int spp) : shown_(shown && ::isatty(STDERR_FILENO)), spp_(spp), start_(Clock::now()) {}
    ~Progress() {
        if (shown_) fmt::print(stderr, "\r\033[K");
    }
    void operator()(int done_spp, double share) {
        if (!shown_) return;
        std::unique_lock const lock(guard_, std::try_to_lock);
        auto const now = Clock::now();
        if (!lock.owns_lock() || now - last_ < std::chrono::milliseconds(200)) return;
        last_ = now;
        double const elapsed = std::chrono::duration<double>(now - start_).count();
        double const left = share > 0 ? elapsed * (1 - share) / share : 0;
        fmt::print(stderr, "\r\033[K{:3.0f} %  {} of {} spp  {:.0f} s, {:.0f} s left", 100 * share, done_spp, spp_,
                   elapsed, left);
        std::fflush(stderr);
    }

  private:
    using Clock = std::chrono::steady_clock;
    bool shown_;
    int spp_;
    Clock::time_point start_, last_;
    std::mutex guard_;
};

struct Outputs {
    std::filesystem::path exr, preview, report;
};

Outputs outputs_of(Options const& o, Scene const& scene) {
    Outputs const out{o.output.empty() ? scene.name + ".exr" : o.output, o.preview, o.report};
    if (out.exr.extension() != ".exr")
        fail("--output", fmt::format("found '{}', but a name ending in .exr is wanted", out.exr.string()));
    if (!out.preview.empty() && out.preview.extension() != ".png")
        fail("--preview", fmt::format("found '{}', but a name ending in .png is wanted", out.preview.string()));
    for (std::filesystem::path const& p : {out.exr, out.preview, out.report})
        if (!p.empty()) check_writable(p);
    return out;
}

RenderSettings settings_of(Options const& o, Scene const& scene) {
    RenderSettings s;
    constexpr int open_ended = 1 << 24;
    s.spp = o.spp > 0 ? o.spp : (o.seconds > 0 || o.error > 0) ? open_ended : scene.render.spp;
    if (o.seconds > 0) s.seconds = o.seconds;
    if (o.error > 0) s.relative_error = o.error;
    s.seed = o.seed >= 0 ? static_cast<std::uint64_t>(o.seed) : scene.render.seed;
    s.sampler = scene.render.sampler;
    s.threads = o.threads;
    s.interrupted = &interrupted;
    return s;
}

std::uint64_t total(std::array<std::uint64_t, rejection_count> const& rejected) {
    std::uint64_t sum = 0;
    for (std::uint64_t r : rejected) sum += r;
    return sum;
}

void write_report(std::filesystem::path const& path, Scene const& scene, std::string const& integrator,
                  RenderReport const& r, Film const& film) {
    nlohmann::ordered_json rejected;
    for (std::size_t i = 0; i < rejection_names.size(); ++i) rejected[rejection_names[i]] = film.rejected()[i];
    std::uint64_t const rays = r.rays.closest_rays + r.rays.shadow_rays;
    nlohmann::ordered_json const out{{"scene", scene.name},
                                     {"integrator", integrator},
                                     {"spp", r.spp},
                                     {"seconds", r.seconds},
                                     {"samples_per_second", static_cast<double>(r.paths) / r.seconds},
                                     {"rays_per_second", static_cast<double>(rays) / r.seconds},
                                     {"embree_share", r.embree_share},
                                     {"rejected", rejected},
                                     {"relative_error", film.relative_error()},
                                     {"interrupted", r.interrupted}};
    write_file(path, out.dump(2) + "\n");
}

void print_summary(RenderReport const& r, Film const& film, std::filesystem::path const& exr) {
    std::uint64_t const rays = r.rays.closest_rays + r.rays.shadow_rays;
    fmt::print(stderr, "{} spp in {:.2f} s: {:.3g} camera paths/s, {:.3g} rays/s, {:.0f} % of the time in Embree\n",
               r.spp, r.seconds, static_cast<double>(r.paths) / r.seconds, static_cast<double>(rays) / r.seconds,
               100 * r.embree_share);
    fmt::print(stderr, "relative error {:.3g}; {} samples rejected; wrote {}\n", film.relative_error(),
               total(film.rejected()), exr.string());
}

int run_render(Options const& o) {
    auto const scene = load_scene(find_scene(o.scene));
    apply_size(*scene, o.size);
    Outputs const out = outputs_of(o, *scene);
    output_space(o.colourspace, scene->film.white);  // to refuse an unknown one before any work
    std::optional<ColourTransform> display;
    if (!out.preview.empty()) display = ColourConfig(o.ocio).to_display("", o.view);
    RenderPlan const plan = make_plan(*scene);
    IntegratorChoice const choice = o.integrator.empty() ? scene->render.integrator : parse_integrator(o.integrator);
    auto const integrator = make_integrator(choice, *scene, plan);
    if (!o.quiet)
        for (std::string const& remark : scene->remarks) fmt::print(stderr, "note: {}\n", remark);

    Film film = make_film(*scene);
    RenderSettings settings = settings_of(o, *scene);
    std::signal(SIGINT, on_interrupt);
    std::signal(SIGTERM, on_interrupt);
    RenderReport report;
    {
        Progress progress(!o.quiet, settings.spp);
        settings.on_progress = [&](int spp, double share) { progress(spp, share); };
        report = render(*scene, plan, *integrator, settings, film);
    }

    write_exr(film,
              {o.colourspace, scene->film.white, scene->film.exposure, scene->film.half, scene->name, scene->hash,
               choice.text(), settings.seed},
              out.exr);
    if (display) write_preview(film, scene->film.white, scene->film.exposure, *display, out.preview);
    if (!out.report.empty()) write_report(out.report, *scene, choice.text(), report, film);
    if (!o.quiet) print_summary(report, film, out.exr);
    if (report.interrupted) {
        fmt::print(stderr, "iride: interrupted; what was finished is saved\n");
        return exit_interrupted;
    }
    std::uint64_t const rejected = total(film.rejected());
    if (static_cast<double>(rejected) > trustworthy_rejections * static_cast<double>(report.paths)) {
        fmt::print(stderr, "iride: {} of {} samples were rejected: do not trust this picture\n", rejected,
                   report.paths);
        return exit_not_trustworthy;
    }
    return exit_done;
}

}  // namespace

Command add_render(CLI::App& app) {
    CLI::App* const parser = app.add_subcommand("render", "Render a scene to an OpenEXR file");
    auto const o = std::make_shared<Options>();
    parser->add_option("SCENE", o->scene, "a scene file or the name of a shipped scene")->required();
    parser->add_option("-o,--output", o->output, "EXR file to write (default: the scene's name in this folder)");
    std::string integrators;
    for (IntegratorEntry const& e : integrator_entries()) integrators += fmt::format("\n  {}: {}", e.name, e.summary);
    parser->add_option("--integrator", o->integrator, "how light is found, NAME or NAME:key=value,...:" + integrators);
    auto* const spp = parser->add_option("--spp", o->spp, "samples per pixel")->check(CLI::Range(1, 1 << 24));
    auto* const seconds =
        parser->add_option("--time", o->seconds, "stop after the pass that ends beyond this many seconds")
            ->check(CLI::PositiveNumber);
    auto* const error =
        parser->add_option("--error", o->error, "stop at this relative error (root mean square over pixels)")
            ->check(CLI::PositiveNumber);
    spp->excludes(seconds)->excludes(error);
    seconds->excludes(error);
    parser->add_option("--seed", o->seed, "seed of the random numbers")->check(CLI::NonNegativeNumber);
    parser->add_option("--threads", o->threads, "threads (default: all)")->check(CLI::Range(1, 1024));
    parser->add_option("--size", o->size, "WIDTHxHEIGHT in pixels, instead of the scene's");
    parser
        ->add_option("--colourspace", o->colourspace,
                     "of the EXR: XYZ ACEScg ACES2065-1 linear-sRGB Rec709 Rec2020 DisplayP3 AdobeRGB")
        ->capture_default_str();
    parser->add_option("--view", o->view, "OpenColorIO view of the preview (default: the config's, ACES SDR)");
    parser->add_option("--ocio", o->ocio, "OpenColorIO config (default: $OCIO, else the shipped one)");
    parser->add_option("--preview", o->preview, "PNG file to write through the view");
    parser->add_option("--report", o->report, "JSON file to write: times, rays, rejected samples, error");
    parser->add_flag("--quiet", o->quiet, "print errors only");
    return {parser, [o] { return run_render(*o); }};
}

}  // namespace iride
