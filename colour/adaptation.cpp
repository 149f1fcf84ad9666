// SPDX-License-Identifier: Apache-2.0
#include "colour/adaptation.h"

#include <Eigen/LU>

namespace iride {

// These numbers are the definitions of the methods.
MatrixDouble cone_matrix(Adaptation method) {
    MatrixDouble m = MatrixDouble::Identity();
    switch (method) {
        case Adaptation::none:
            break;
        case Adaptation::von_kries:
            m << 0.40024, 0.70760, -0.08081, -0.22630, 1.16532, 0.04570, 0, 0, 0.91822;
            break;
        case Adaptation::bradford:
            m << 0.8951, 0.2664, -0.1614, -0.7502, 1.7135, 0.0367, 0.0389, -0.0685, 1.0296;
            break;
        case Adaptation::cat02:
            m << 0.7328, 0.4296, -0.1624, -0.7036, 1.6975, 0.0061, 0.0030, 0.0136, 0.9834;
            break;
        case Adaptation::cat16:
            m << 0.401288, 0.650173, -0.051461, -0.250268, 1.204414, 0.045854, -0.002079, 0.048952, 0.953127;
            break;
    }
    return m;
}

MatrixDouble adaptation_matrix(Chromaticity const& from, Chromaticity const& to, Adaptation method) {
    if (from == to || method == Adaptation::none) return MatrixDouble::Identity();
    MatrixDouble const m = cone_matrix(method);
    VectorDouble const source = m * to_vector(to_xyz(from, 1)), target = m * to_vector(to_xyz(to, 1));
    return m.inverse() * target.cwiseQuotient(source).asDiagonal() * m;
}

}  // namespace iride
