// SPDX-License-Identifier: Apache-2.0
// iride render SCENE: from a scene file to an EXR, a preview and a report.
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <csignal>
#include <memory>
#include <mutex>
#include <nlohmann/json.hpp>
#include <thread>

#include "app/command.h"
#include "base/atomic_file.h"
#include "base/clock.h"
#include "film/checkpoint.h"
#include "film/preview.h"
#include "integrators/adaptive.h"
#include "integrators/layers.h"
#include "integrators/plan_disable.h"
#include "integrators/radiosity/radiosity.h"
#include "integrators/radiosity/solution_file.h"

namespace iride {

namespace {

struct Options {
    std::string scene, output, integrator, size, crop, error, colourspace = "ACEScg", view, ocio, preview, report,
                                                              checkpoint, solution, sampler;
    std::optional<std::string> aov;
    int spp = 0, threads = 0;
    double seconds = 0, checkpoint_seconds = 30;
    std::int64_t seed = -1;
    std::uint32_t first_sample = 0;
    bool adaptive = false, quiet = false;
    std::vector<std::string> plan_disabled;
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

std::optional<Crop> crop_of(Scene const& scene, std::string const& crop) {
    if (crop.empty()) return std::nullopt;
    Crop c{};
    int used = 0;
    if (std::sscanf(crop.c_str(), "%d,%d,%d,%d%n", &c.x0, &c.y0, &c.x1, &c.y1, &used) != 4 ||
        used != static_cast<int>(crop.size()) || c.x0 < 0 || c.y0 < 0 || c.x0 >= c.x1 || c.y0 >= c.y1 ||
        c.x1 > scene.film.width || c.y1 > scene.film.height)
        fail("--crop",
             fmt::format("found '{}', allowed: X0,Y0,X1,Y1 with 0 <= X0 < X1 <= {} and 0 <= Y0 < Y1 <= {}; the "
                         "pixels X0 <= x < X1, Y0 <= y < Y1 are rendered",
                         crop, scene.film.width, scene.film.height));
    return c;
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
    check_output("--output", out.exr, ".exr");
    if (!out.preview.empty()) check_output("--preview", out.preview, ".png");
    for (std::filesystem::path const& p : {out.report, std::filesystem::path(o.checkpoint)})
        if (!p.empty()) check_writable(p);
    return out;
}

// What there is of the picture, saved every so often; what a file of that name holds is gone on with.
class Saving {
  public:
    Saving(Options const& o, ExrSettings const& settings, AdaptiveState start)
        : path_(o.checkpoint), every_(o.checkpoint_seconds), state_{settings, std::move(start.films), start.round} {
        std::error_code ignored;
        if (path_.empty() || !std::filesystem::exists(path_, ignored)) return;
        Checkpoint found = read_checkpoint(path_);
        std::vector<Diagnostic> wrong;
        for (std::string const& difference : differences(found, state_)) {
            Diagnostic& d = wrong.emplace_back();
            d.where.file = path_.string();
            d.key_path = "--checkpoint";
            d.message = "is of another render: " + difference;
        }
        if (!wrong.empty()) throw InputError(std::move(wrong));
        state_.films = std::move(found.films);
        state_.round = found.round;
    }
    Checkpoint& state() { return state_; }
    void on_pass() {
        if (path_.empty() || Clock::now() - last_ < std::chrono::duration<double>(every_)) return;
        save();
    }
    // What cannot be saved is said once, and the render goes on: the file of before is still there.
    void save() {
        if (path_.empty()) return;
        try {
            write_checkpoint(state_, path_);
            failed_ = false;
        } catch (InputError const& e) {
            if (!failed_) fmt::print(stderr, "iride: {}; the checkpoint of before stays\n", e.what());
            failed_ = true;
        }
        last_ = Clock::now();
    }

  private:
    std::filesystem::path path_;
    double every_;  // seconds
    Checkpoint state_;
    Clock::time_point last_ = Clock::now();
    bool failed_ = false;
};

RenderSettings settings_of(Options const& o, Scene const& scene) {
    RenderSettings s;
    constexpr int open_ended = 1 << 24;
    s.spp = o.spp > 0 ? o.spp : (o.seconds > 0 || !o.error.empty()) ? open_ended : scene.render.spp;
    if (o.seconds > 0) s.seconds = o.seconds;
    if (!o.error.empty()) {
        s.stop_at = ErrorTarget::parse(o.error);
        s.stop_at->set_display(scene.film.white, scene.film.exposure);
    }
    s.first_sample = o.first_sample;
    if (!o.checkpoint.empty()) s.pass_seconds = o.checkpoint_seconds;
    s.seed = o.seed >= 0 ? static_cast<std::uint64_t>(o.seed) : scene.render.seed;
    s.sampler = o.sampler.empty() ? scene.render.sampler : *sampler_of(o.sampler);
    s.threads = o.threads;
    s.interrupted = &interrupted;
    return s;
}

struct SampleSpread {
    std::uint32_t min, max;
    double mean;
};
SampleSpread sample_spread(Film const& film) {
    auto const [least, most] = std::ranges::minmax_element(film.pixels(), {}, &FilmPixel::count);
    return {least->count, most->count,
            static_cast<double>(film.total_samples()) / static_cast<double>(film.pixels().size())};
}

std::uint64_t total(std::array<std::uint64_t, rejection_count> const& rejected) {
    std::uint64_t sum = 0;
    for (std::uint64_t r : rejected) sum += r;
    return sum;
}

void write_report(std::filesystem::path const& path, Scene const& scene, std::string const& integrator,
                  RenderReport const& r, Film const& film) {
    SampleSpread const spread = sample_spread(film);
    nlohmann::ordered_json rejected;
    for (std::size_t i = 0; i < rejection_names.size(); ++i) rejected[rejection_names[i]] = film.rejected()[i];
    std::uint64_t const rays = r.rays.rays();
    nlohmann::ordered_json const out{{"scene", scene.name},
                                     {"integrator", integrator},
                                     {"spp", r.spp},
                                     {"seconds", r.seconds},
                                     {"spp_min", spread.min},
                                     {"spp_mean", spread.mean},
                                     {"spp_max", spread.max},
                                     {"samples_per_second", static_cast<double>(r.paths) / r.seconds},
                                     {"rays_per_second", static_cast<double>(rays) / r.seconds},
                                     {"embree_share", r.embree_share},
                                     {"rejected", rejected},
                                     {"relative_error", film.relative_error()},
                                     {"interrupted", r.interrupted}};
    write_file(path, out.dump(2) + "\n");
}

void print_summary(RenderReport const& r, Film const& film, std::filesystem::path const& exr) {
    std::uint64_t const rays = r.rays.rays();
    SampleSpread const spread = sample_spread(film);
    if (spread.min != spread.max)
        fmt::print(stderr, "samples per pixel {} .. {}, {:.1f} in the mean\n", spread.min, spread.max, spread.mean);
    fmt::print(stderr, "{} spp in {:.2f} s: {:.3g} camera paths/s, {:.3g} rays/s, {:.0f} % of the time in Embree\n",
               r.spp, r.seconds, static_cast<double>(r.paths) / r.seconds, static_cast<double>(rays) / r.seconds,
               100 * r.embree_share);
    fmt::print(stderr, "relative error {:.3g}; {} samples rejected; wrote {}\n", film.relative_error(),
               total(film.rejected()), exr.string());
}

RenderReport sampled(Scene const& scene, RenderPlan const& plan, Integrator& integrator, RenderSettings const& settings,
                     Checkpoint& state) {
    if (state.films.size() == 1) return render(scene, plan, integrator, settings, state.films.front());
    return render_adaptively(scene, plan, integrator, settings, settings.stop_at, state.films, state.round);
}

// Light paths that pixels share have no pixel's number of samples, and their splats belong to the whole picture.
void check_goes_with(Integrator const& integrator, std::string const& name, Options const& o) {
    for (auto const& [option, hindered] : {std::pair("--adaptive", o.adaptive && integrator.shares_light_paths()),
                                           {"--crop", !o.crop.empty() && integrator.splats()}})
        if (hindered)
            fail(option, fmt::format("does not go with integrator '{}', whose pixels share their light paths", name));
}

int run_render(Options const& o) {
    if (o.adaptive && o.error.empty() && o.seconds == 0) fail("--adaptive", "needs --error or --time to say how far");
    auto const scene = load_scene(find_scene(o.scene));
    apply_size(*scene, o.size);
    std::optional<Crop> const crop = crop_of(*scene, o.crop);
    Outputs const out = outputs_of(o, *scene);
    output_space(o.colourspace, scene->film.white);  // to refuse an unknown one before any work
    std::optional<ColourTransform> display;
    if (!out.preview.empty()) display = ColourConfig(o.ocio).to_display("", o.view);
    if (o.aov) scene->film.aovs = parse_layers(*o.aov);
    RenderPlan plan = make_plan_without(o.plan_disabled, *scene);
    if (o.adaptive) plan.no_light_paths = "pixels have numbers of samples of their own";
    if (!o.crop.empty()) plan.no_light_paths = "a crop has no light paths of its own";
    IntegratorChoice const choice = o.integrator.empty() ? scene->render.integrator : parse_integrator(o.integrator);
    std::string const& name = choice.name;
    if (!o.solution.empty() && name != "radiosity")
        fail("--solution", fmt::format("found integrator '{}', allowed: radiosity", name));
    auto const integrator = o.solution.empty() ? make_integrator(choice, *scene, plan)
                                               : radiosity::show(radiosity::load_solution(o.solution, *scene));
    check_goes_with(*integrator, name, o);
    std::vector<std::string> const layers = check_layers(scene->film.aovs, *scene, plan, name, o.adaptive);
    if (!o.quiet)
        for (auto const& remarks : {scene->remarks, integrator->remarks()})
            for (std::string const& remark : remarks) fmt::print(stderr, "note: {}\n", remark);

    RenderSettings settings = settings_of(o, *scene);
    ExrSettings const of{o.colourspace,    scene->film.white, scene->film.exposure,
                         scene->film.half, scene->name,       scene->hash,
                         choice.text(),    settings.seed,     sampler_names[static_cast<std::size_t>(settings.sampler)],
                         o.first_sample,   o.adaptive};
    Saving saving(o, of, o.adaptive ? make_adaptive_state(*scene, crop) : AdaptiveState{{make_film(*scene, crop)}, 0});
    std::signal(SIGINT, on_interrupt);
    std::signal(SIGTERM, on_interrupt);
    RenderReport report;
    {
        Progress progress(!o.quiet, settings.spp);
        settings.on_progress = [&](int spp, double share) { progress(spp, share); };
        settings.on_pass = [&] { saving.on_pass(); };
        report = sampled(*scene, plan, *integrator, settings, saving.state());
    }
    saving.save();

    Film const film = picture_of(saving.state().films);
    write_exr(film, of, out.exr, make_layers(layers, *scene, plan, name, settings, film, of));
    if (display) write_preview(film, scene->film.white, scene->film.exposure, *display, out.preview);
    if (!out.report.empty()) write_report(out.report, *scene, choice.text(), report, film);
    if (!o.quiet) print_summary(report, film, out.exr);
    if (report.interrupted) {
        fmt::print(stderr, "iride: interrupted; what was finished is saved\n");
        return exit_interrupted;
    }
    std::uint64_t const rejected = total(film.rejected()), taken = film.total_samples() + rejected;
    if (static_cast<double>(rejected) > trustworthy_rejections * static_cast<double>(taken)) {
        fmt::print(stderr, "iride: {} of {} samples were rejected: do not trust this picture\n", rejected, taken);
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
    auto* const error = parser->add_option("--error", o->error,
                                           "stop at this relative error (root mean square over pixels), or, as de=0.5, "
                                           "at this CIEDE2000 error in 99 % of them");
    parser->add_flag("--adaptive", o->adaptive,
                     "with --error or --time: more samples where there is more noise, unbiased");
    spp->excludes(seconds)->excludes(error);
    seconds->excludes(error);
    parser->add_option("--seed", o->seed, "seed of the random numbers")->check(CLI::NonNegativeNumber);
    parser
        ->add_option("--first-sample", o->first_sample,
                     "number of the first sample: shares of a picture, for iride merge")
        ->check(CLI::Range(0, 1 << 24));
    parser->add_option("--crop", o->crop, "X0,Y0,X1,Y1: only these pixels of the picture");
    std::string layers;
    for (LayerEntry const& e : layer_entries()) layers += fmt::format("\n  {}: {}", e.name, e.summary);
    parser->add_option(
        "--aov", o->aov,
        "more layers for the EXR, by name, separated by commas, instead of the file's film.aovs:" + layers);
    parser->add_option("--checkpoint", o->checkpoint, "file to save all samples in, and to go on from if it is there");
    parser
        ->add_option("--checkpoint-every", o->checkpoint_seconds,
                     "seconds between two of them, or a pass if that is longer")
        ->check(CLI::NonNegativeNumber)
        ->capture_default_str();
    parser
        ->add_option(
            "--sampler", o->sampler,
            "random numbers: zsobol (Owen-scrambled Sobol' points, shared out among neighbouring pixels), sobol (each "
            "pixel for itself), stratified or independent; instead of the file's")
        ->check(CLI::IsMember(std::vector<std::string>(sampler_names.begin(), sampler_names.end())));
    parser->add_option("--threads", o->threads, "threads (default: all)")->check(CLI::Range(1, 1024));
    parser->add_option("--size", o->size, "WIDTHxHEIGHT in pixels, instead of the scene's");
    parser
        ->add_option("--colourspace", o->colourspace,
                     "of the EXR: XYZ ACEScg ACES2065-1 linear-sRGB Rec709 Rec2020 DisplayP3 AdobeRGB")
        ->capture_default_str();
    parser->add_option("--view", o->view, "OpenColorIO view of the preview (default: the config's, ACES SDR)");
    parser->add_option("--ocio", o->ocio, "OpenColorIO config (default: $OCIO, else the shipped one)");
    parser->add_option("--preview", o->preview, "PNG file to write through the view");
    parser->add_option("--solution", o->solution, "with --integrator radiosity: what iride radiosity --save wrote");
    parser->add_option("--report", o->report, "JSON file to write: times, rays, rejected samples, error");
    add_plan_disable(*parser, o->plan_disabled);
    parser->add_flag("--quiet", o->quiet, "print errors only");
    return {parser, [o] { return run_render(*o); }};
}

}  // namespace iride
