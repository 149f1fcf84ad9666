// SPDX-License-Identifier: Apache-2.0
#include "film/checkpoint.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <fstream>
#include <map>

#include "base/atomic_file.h"
#include "base/diagnostics.h"
#include "base/numbers_in_text.h"
#include "base/random.h"
#include "film/film.h"

namespace iride {

namespace {

constexpr char const* first_words = "iride checkpoint ";  // and the format's number
constexpr char const* format = "4";
constexpr int largest_side = 1 << 16;          // pixels
constexpr std::size_t longest_head = 1 << 16;  // bytes
static_assert(sizeof(FilmPixel) == 10 * sizeof(double) + 4 * sizeof(std::uint32_t), "a pixel has no padding");

[[noreturn]] void fail(std::filesystem::path const& path, std::string const& message) {
    throw InputError({path.string()}, "", message);
}

using Facts = std::vector<std::pair<std::string, std::string>>;

// What a render is of, in words; resuming asks for the same in all, but for what is only taken along.
Facts facts_of(Checkpoint const& c) {
    ExrSettings const& s = c.settings;
    Film const& film = c.films.front();
    FilmPlace const& p = film.place();
    std::string const bands = film.bands() ? fmt::format("{} {} {}", film.bands()->count, film.bands()->range.min_nm,
                                                         film.bands()->range.max_nm)
                                           : "0 0 0";
    return {{"version", IRIDE_VERSION},
            {"byte order", std::endian::native == std::endian::little ? "little" : "big"},
            {"lanes", std::to_string(lane_count)},
            {"scene", s.scene},
            {"scene hash", s.scene_hash},
            {"integrator", s.integrator},
            {"sampler", s.sampler},
            {"seed", std::to_string(s.seed)},
            {"first sample", std::to_string(s.first_sample)},
            {"size", fmt::format("{} {}", p.picture_width, p.picture_height)},
            {"crop", fmt::format("{} {} {} {}", p.x0, p.y0, p.x0 + film.width(), p.y0 + film.height())},
            {"observer", film.observer().name},
            {"bands", bands},
            {"films", std::to_string(c.films.size())},
            {"splats", film.splats() ? "1" : "0"},
            {"round", std::to_string(c.round)},
            {"exposure", fmt::format("{}", s.exposure)},
            {"white", fmt::format("{} {}", s.scene_white.x, s.scene_white.y)},
            {"half", s.half ? "1" : "0"}};
}

bool matters(std::string const& key) {
    constexpr std::array taken_along{"scene", "splats", "round", "exposure", "white", "half"};
    return std::ranges::find(taken_along, key) == taken_along.end();
}

std::vector<std::string> differing(Checkpoint const& a, Checkpoint const& b, auto&& is_asked) {
    std::vector<std::string> all;
    Facts const first = facts_of(a), second = facts_of(b);
    for (std::size_t i = 0; i < first.size(); ++i)
        if (is_asked(first[i].first) && first[i].second != second[i].second)
            all.push_back(fmt::format("its {} is {}, here {}", first[i].first, first[i].second, second[i].second));
    return all;
}

std::uint64_t hashed(std::uint64_t hash, void const* data, std::size_t size) {
    auto const* const bytes = static_cast<unsigned char const*>(data);
    std::size_t i = 0;
    for (; i + 8 <= size; i += 8) {
        std::uint64_t word;
        std::memcpy(&word, bytes + i, 8);
        hash = mix_bits(hash * 31 + word);
    }
    for (; i < size; ++i) hash = mix_bits(hash * 31 + bytes[i]);
    return hash;
}

// A head's values, asked for by key; anything missing or senseless makes the file a damaged one.
class Head {
  public:
    Head(std::filesystem::path const& path, std::ifstream& in) : path_(path) {
        std::string line;
        std::getline(in, line);
        format_ = line.substr(std::strlen(first_words));
        text_ = line + "\n";
        for (std::size_t size = 0; std::getline(in, line) && !line.empty(); text_ += line + "\n") {
            if ((size += line.size()) > longest_head) damaged();
            auto const colon = line.find(": ");
            if (colon != std::string::npos) value_[line.substr(0, colon)] = line.substr(colon + 2);
        }
        if (!in) damaged();
    }
    std::string const& text() const { return text_; }
    std::string const& format() const { return format_; }
    std::string const& operator[](std::string const& key) const {
        auto const found = value_.find(key);
        if (found == value_.end()) damaged();
        return found->second;
    }
    template <class Number>
    std::vector<Number> numbers(std::string const& key, std::size_t count) const {
        auto all = numbers_in<Number>((*this)[key], count);
        if (!all) damaged();
        return std::move(*all);
    }
    template <class Number>
    Number number(std::string const& key) const {
        return numbers<Number>(key, 1).front();
    }
    [[noreturn]] void damaged() const { fail(path_, "is a truncated or damaged checkpoint"); }

  private:
    std::filesystem::path path_;
    std::string text_, format_;
    std::map<std::string, std::string> value_;
};

ExrSettings settings_of(Head const& head) {
    ExrSettings s;
    s.scene = head["scene"];
    s.scene_hash = head["scene hash"];
    s.integrator = head["integrator"];
    s.sampler = head["sampler"];
    s.seed = head.number<std::uint64_t>("seed");
    s.first_sample = head.number<std::uint32_t>("first sample");
    s.exposure = head.number<double>("exposure");
    auto const white = head.numbers<double>("white", 2);
    s.scene_white = {white[0], white[1]};
    s.half = head["half"] == "1";
    return s;
}

// An empty film as the head describes it; `bytes`: what the file has for each, which bounds what is allocated.
Film film_of(Head const& head, std::uintmax_t bytes) {
    auto const size = head.numbers<int>("size", 2), crop = head.numbers<int>("crop", 4);
    for (int s : size)
        if (s < 1 || s > largest_side) head.damaged();
    bool const inside = crop[0] >= 0 && crop[1] >= 0 && crop[0] < crop[2] && crop[1] < crop[3] && crop[2] <= size[0] &&
                        crop[3] <= size[1];
    if (!inside) head.damaged();
    auto const band = head.numbers<double>("bands", 3);
    std::optional<Bands> bands;
    if (band[0] > 0) bands = Bands{{band[1], band[2]}, static_cast<int>(band[0])};
    auto const pixels = static_cast<std::uintmax_t>(crop[2] - crop[0]) * static_cast<std::uintmax_t>(crop[3] - crop[1]);
    auto const count = static_cast<std::uintmax_t>(std::clamp(band[0], 0.0, 1e6));
    bool const splats = head["splats"] == "1";
    std::uintmax_t const of_splats = splats ? Splats::size_in_file(pixels, count) : 0;
    if (pixels * (sizeof(FilmPixel) + count * sizeof(double)) + of_splats > bytes) head.damaged();
    if (head["observer"] != cie1931_2deg().name) head.damaged();
    Film film(crop[2] - crop[0], crop[3] - crop[1], {crop[0], crop[1], size[0], size[1]}, cie1931_2deg(),
              WavelengthGrid::covering(visible_range), bands);
    if (splats) film.add_splat_layer();
    return film;
}

// Calls `use(data, size)` for all that films hold.
void for_each_block(auto& films, auto&& use) {
    for (auto& film : films) {
        use(film.pixels().data(), film.pixels().size() * sizeof(FilmPixel));
        use(film.band_sums().data(), film.band_sums().size() * sizeof(double));
        if (film.splats()) film.splats()->for_each_block(use);
    }
}

bool is_number_sane(Film const& film) {
    return std::ranges::all_of(film.pixels(), [](FilmPixel const& p) {
        return std::ranges::all_of(p.sum, [](double s) { return std::isfinite(s); });
    });
}

// The samples of a pixel lie in [first, first + most taken of any pixel): whether two such ranges meet.
bool share_samples(Checkpoint const& a, Checkpoint const& b) {
    if (a.settings.seed != b.settings.seed || a.settings.sampler != b.settings.sampler) return false;
    Film const &p = a.films.front(), &q = b.films.front();
    auto const apart = [](int a0, int a1, int b0, int b1) { return a1 <= b0 || b1 <= a0; };
    if (apart(p.place().x0, p.place().x0 + p.width(), q.place().x0, q.place().x0 + q.width()) ||
        apart(p.place().y0, p.place().y0 + p.height(), q.place().y0, q.place().y0 + q.height()))
        return false;
    auto const end = [](Checkpoint const& c) {
        std::uint64_t most = 0;
        for (Film const& film : c.films)
            for (FilmPixel const& pixel : film.pixels()) most = std::max<std::uint64_t>(most, pixel.taken());
        return c.settings.first_sample + most;
    };
    return a.settings.first_sample < end(b) && b.settings.first_sample < end(a);
}

}  // namespace

void write_checkpoint(Checkpoint const& checkpoint, std::filesystem::path const& path) {
    AtomicFile file(path);
    std::string head = std::string(first_words) + format + "\n";
    for (auto const& [key, value] : facts_of(checkpoint)) head += key + ": " + value + "\n";
    head += "\n";
    std::ofstream out(file.temporary(), std::ios::binary);
    std::uint64_t hash = 0;
    auto const put = [&](void const* data, std::size_t size) {
        out.write(static_cast<char const*>(data), static_cast<std::streamsize>(size));
        hash = hashed(hash, data, size);
    };
    put(head.data(), head.size());
    for_each_block(checkpoint.films, put);
    out.write(reinterpret_cast<char const*>(&hash), sizeof hash);
    out.close();
    if (!out) fail(path, "cannot be written: the disk took only a part of it");
    file.commit();
}

bool is_checkpoint(std::filesystem::path const& path) {
    std::ifstream in(path, std::ios::binary);
    std::string start(std::strlen(first_words), '\0');
    in.read(start.data(), static_cast<std::streamsize>(start.size()));
    return in && start == first_words;
}

Checkpoint read_checkpoint(std::filesystem::path const& path) {
    std::error_code error;
    if (!std::filesystem::exists(path, error)) fail(path, "no such file");
    if (!std::filesystem::is_regular_file(path, error)) fail(path, "is not a regular file");
    if (!is_checkpoint(path)) fail(path, "is no checkpoint of this program");
    std::ifstream in(path, std::ios::binary);
    Head const head(path, in);
    if (head.format() != format)
        fail(path,
             fmt::format("is a checkpoint of format {}; this version reads and writes {}", head.format(), format));
    if (head["byte order"] != (std::endian::native == std::endian::little ? "little" : "big") ||
        head["lanes"] != std::to_string(lane_count) || head["version"] != IRIDE_VERSION)
        fail(path,
             fmt::format("was written by version {} with {} lanes and {}-endian numbers; this is version {} with {}",
                         head["version"], head["lanes"], head["byte order"], IRIDE_VERSION, lane_count));
    std::uintmax_t const size = std::filesystem::file_size(path);
    Checkpoint c{settings_of(head), {}, head.number<int>("round")};
    auto const count = head.number<std::size_t>("films");
    if (count != 1 && count != 4) head.damaged();
    c.settings.adaptive = count == 4;
    Film const empty = film_of(head, size / count);
    c.films.assign(count, empty);
    std::string const text = head.text() + "\n";
    std::uint64_t hash = hashed(0, text.data(), text.size()), written = 0;
    for_each_block(c.films, [&](void* data, std::size_t bytes) {
        in.read(static_cast<char*>(data), static_cast<std::streamsize>(bytes));
        if (in) hash = hashed(hash, data, bytes);
    });
    in.read(reinterpret_cast<char*>(&written), sizeof written);
    if (!in || in.peek() != std::ifstream::traits_type::eof() || hash != written) head.damaged();
    if (!std::ranges::all_of(c.films, is_number_sane)) head.damaged();
    return c;
}

std::vector<std::string> differences(Checkpoint const& found, Checkpoint const& wanted) {
    return differing(found, wanted, matters);
}

std::vector<std::string> obstacles_to_merging(Checkpoint const& a, Checkpoint const& b) {
    std::vector<std::string> all = differing(a, b, [](std::string const& key) {
        return matters(key) && key != "seed" && key != "first sample" && key != "crop" && key != "sampler";
    });
    if (all.empty() && share_samples(a, b))
        all.push_back(fmt::format("both have the same samples of some pixels: seed {}, from {} and from {}",
                                  a.settings.seed, a.settings.first_sample, b.settings.first_sample));
    return all;
}

Film picture_of(std::vector<Film> const& films) {
    if (films.size() == 1) return films.front();
    Film a = films[0], b = films[1];
    a.add(films[2]);
    b.add(films[3]);
    return Film::half_and_half(a, b);
}

std::vector<Film> merged(std::vector<Checkpoint> const& parts) {
    FilmPlace place = parts.front().films.front().place();
    int x1 = 0, y1 = 0;
    for (Checkpoint const& part : parts) {
        Film const& film = part.films.front();
        place.x0 = std::min(place.x0, film.place().x0);
        place.y0 = std::min(place.y0, film.place().y0);
        x1 = std::max(x1, film.place().x0 + film.width());
        y1 = std::max(y1, film.place().y0 + film.height());
    }
    Film const& first = parts.front().films.front();
    Film const empty(x1 - place.x0, y1 - place.y0, place, first.observer(), WavelengthGrid::covering(visible_range),
                     first.bands());
    std::vector<Film> whole(parts.front().films.size(), empty);
    for (Checkpoint const& part : parts)
        for (std::size_t i = 0; i < whole.size(); ++i) whole[i].add(part.films[i]);
    return whole;
}

}  // namespace iride
