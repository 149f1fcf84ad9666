// SPDX-License-Identifier: Apache-2.0
#include "base/diagnostics.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace iride {

namespace {

std::string joined(std::vector<Diagnostic> const& diagnostics) {
    std::string all;
    for (Diagnostic const& d : diagnostics) {
        if (!all.empty()) all += '\n';
        all += d.text();
    }
    return all;
}

// Optimal string alignment distance: insertions, deletions, substitutions and swaps of neighbours cost 1.
std::size_t edit_distance(std::string_view a, std::string_view b) {
    std::vector<std::vector<std::size_t>> d(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
    for (std::size_t i = 0; i <= a.size(); ++i) d[i][0] = i;
    for (std::size_t j = 0; j <= b.size(); ++j) d[0][j] = j;
    for (std::size_t i = 1; i <= a.size(); ++i)
        for (std::size_t j = 1; j <= b.size(); ++j) {
            std::size_t const change = a[i - 1] == b[j - 1] ? 0 : 1;
            d[i][j] = std::min({d[i - 1][j] + 1, d[i][j - 1] + 1, d[i - 1][j - 1] + change});
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
                d[i][j] = std::min(d[i][j], d[i - 2][j - 2] + 1);
        }
    return d[a.size()][b.size()];
}

}  // namespace

std::string Diagnostic::text() const {
    std::string place = where.file;
    if (where.line > 0) place += fmt::format(":{}:{}", where.line, where.column);
    if (!place.empty()) place += ": ";
    return place + (key_path.empty() ? "" : key_path + ": ") + message;
}

InputError::InputError(std::vector<Diagnostic> diagnostics)
    : std::runtime_error(joined(diagnostics)), diagnostics_(std::move(diagnostics)) {}
InputError::InputError(SourceLocation where, std::string key_path, std::string message)
    : InputError(std::vector{Diagnostic{std::move(where), std::move(key_path), std::move(message)}}) {}

std::string nearest_name(std::string_view name, std::vector<std::string> const& candidates) {
    constexpr std::size_t longest_name = 64;  // longer ones are no slip of the pen, and the table grows as the product
    if (name.size() > longest_name) return {};
    std::string best;
    std::size_t best_distance = std::min(std::max<std::size_t>(1, name.size() / 3) + 1, name.size());
    for (std::string const& candidate : candidates) {
        std::size_t const distance = edit_distance(name, candidate);
        if (distance < best_distance) best = candidate, best_distance = distance;
    }
    return best;
}

std::string suggestion(std::string_view name, std::vector<std::string> const& candidates) {
    std::string const near = nearest_name(name, candidates);
    if (!near.empty()) return fmt::format("; did you mean '{}'?", near);
    return candidates.empty() ? "" : fmt::format("; allowed: {}", fmt::join(candidates, ", "));
}

}  // namespace iride
