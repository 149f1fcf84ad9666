// SPDX-License-Identifier: Apache-2.0
// What is asked of an integrator, by name and type, with what holds where nothing is said. Errors are collected with
// their place; finish() reports them and every key that nobody asked for.
#pragma once

#include <optional>
#include <span>
#include <utility>

#include "scene/fields.h"
#include "scene/integrator_choice.h"

namespace iride {

class IntegratorOptions {
  public:
    explicit IntegratorOptions(IntegratorChoice const& choice)
        : context_{choice.file, {}, {}, {}, {}}, fields_(context_, choice.options, choice.key_path) {}
    IntegratorOptions(IntegratorOptions const&) = delete;
    IntegratorOptions& operator=(IntegratorOptions const&) = delete;

    // Absent: nothing was said.
    std::optional<double> number(std::string const& key, Limits const& limits) { return fields_.number(key, limits); }
    double number(std::string const& key, Limits const& limits, double otherwise) {
        return number(key, limits).value_or(otherwise);
    }
    int integer(std::string const& key, int least, int most, int otherwise) {
        return fields_.integer(key, least, most).value_or(otherwise);
    }
    bool boolean(std::string const& key, bool otherwise) { return fields_.boolean(key).value_or(otherwise); }
    // One of a table of names.
    template <class Value, std::size_t N>
    Value one_of(std::string const& key, std::pair<char const*, Value> const (&table)[N], Value otherwise) {
        std::vector<std::string> names;
        for (auto const& entry : table) names.emplace_back(entry.first);
        auto const found = fields_.choice(key, names);
        if (!found) return otherwise;
        for (auto const& [name, value] : table)
            if (*found == name) return value;
        return otherwise;
    }
    // The name of one of a table's entries.
    template <class Entry>
    std::string word(std::string const& key, std::span<Entry const> table, std::string const& otherwise) {
        std::vector<std::string> names;
        for (Entry const& entry : table) names.emplace_back(entry.name);
        return fields_.choice(key, names).value_or(otherwise);
    }
    // An option that is good by itself but not here.
    void error_at(std::string const& key, std::string const& message) { fields_.error_at(key, message); }

    // After the last question and before any work: throws one InputError with all that is wrong.
    void finish() {
        fields_.finish();
        if (!context_.diagnostics.empty()) throw InputError(std::move(context_.diagnostics));
    }

  private:
    ReadContext context_;
    Fields fields_;
};

}  // namespace iride
