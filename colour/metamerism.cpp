// SPDX-License-Identifier: Apache-2.0
#include "colour/metamerism.h"

#include "base/diagnostics.h"

namespace iride {

Metamerism metamerism(SpectralFunction const& standard, SpectralFunction const& sample,
                      TristimulusWeights const& reference, TristimulusWeights const& test,
                      DifferenceFormula const& formula) {
    auto const difference = [&](Xyz const& a, Xyz const& b, Xyz const& white) {
        return formula.of(to_lab(a, white), to_lab(b, white));
    };
    Xyz const p = reference.of(standard), q = reference.of(sample);
    if (!(q.X > 0 && q.Y > 0 && q.Z > 0))
        throw InputError({}, sample.name(), "is black under the reference illuminant: it is metameric to nothing");
    Xyz const p_test = test.of(standard), q_test = test.of(sample);
    Xyz const corrected{q_test.X * (p.X / q.X), q_test.Y * (p.Y / q.Y), q_test.Z * (p.Z / q.Z)};
    return {difference(p, q, reference.white()), difference(p_test, corrected, test.white()),
            difference(p_test, q_test, test.white())};
}

}  // namespace iride
