// SPDX-License-Identifier: Apache-2.0
// Metamerism: two objects that match under one illuminant and differ under another. [CIE 15:2018, 9.6]
#pragma once

#include "colour/difference.h"
#include "colour/tristimulus.h"

namespace iride {

struct Metamerism {
    double reference_difference;  // under the illuminant where they should match
    double index;                 // under the test illuminant, the mismatch under the reference taken out
    double uncorrected;           // under the test illuminant as they are

    bool are_metamers(double tolerance) const { return reference_difference <= tolerance; }
};

// Special index of metamerism for a change of illuminant. The sample's XYZ under the test illuminant are multiplied by
// those of the standard over its own under the reference; L*a*b* is taken against each illuminant's white. Throws
// InputError if the sample's X, Y or Z under the reference is 0.
Metamerism metamerism(SpectralFunction const& standard, SpectralFunction const& sample,
                      TristimulusWeights const& reference, TristimulusWeights const& test,
                      DifferenceFormula const& formula);

}  // namespace iride
