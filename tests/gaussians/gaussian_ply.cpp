// SPDX-License-Identifier: Apache-2.0
#include "tests/gaussians/gaussian_ply.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>

namespace pointrt::test {

namespace {

static_assert(std::endian::native == std::endian::little, "values are read and written as they lie in memory");

/// The constant harmonic, 1 / (2 sqrt(pi)).
constexpr double kConstantHarmonic = 0.28209479177387814;

/// The largest logit: in single precision 1 / (1 + exp(-40)) is already 1.
constexpr double kLargestLogit = 40;

[[noreturn]] void fail(const std::string& path, const std::string& reason) {
    throw std::runtime_error(path + ": " + reason);
}

struct PlyLayout {
    std::size_t count = 0;
    std::map<std::string, std::size_t> columns; ///< property name to its number
};

void readProperty(const std::string& path, std::istringstream& words, PlyLayout& layout) {
    std::string type, name;
    words >> type >> name;
    if (type != "float" && type != "float32") fail(path, "property " + name + " is not a float");
    const std::size_t number = layout.columns.size();
    layout.columns[name] = number;
}

/// Reads the header up to and including its last line. What follows the vertices is ignored.
PlyLayout readPlyLayout(const std::string& path, std::istream& file) {
    PlyLayout layout;
    std::string line, element, word;
    while (std::getline(file, line) && line.rfind("end_header", 0) != 0) {
        std::istringstream words(line);
        words >> word;
        if (word == "format" && words >> word && word != "binary_little_endian") fail(path, "not binary_little_endian");
        if (word == "element") {
            const bool is_first = element.empty();
            words >> element;
            if (element == "vertex" && !is_first) fail(path, "vertices must be the first element");
            if (element == "vertex") words >> layout.count;
        }
        if (word == "property" && element == "vertex") readProperty(path, words, layout);
    }
    if (!file || layout.columns.empty()) fail(path, "not a PLY with vertices");
    return layout;
}

/// Number of a channel's coefficients besides the constant one.
std::size_t harmonicsIn(const PlyLayout& layout) {
    std::size_t values = 0;
    while (layout.columns.count("f_rest_" + std::to_string(values))) ++values;
    return values / 3;
}

/// Indices of a Gaussian's numbers in the order of columnsOf; harmonics follow.
enum Plain { kMean, kColor = 3, kOpacity = 6, kScale = 7, kRotation = 10, kPlainCount = 14 };

std::vector<std::string> columnsOf(std::size_t harmonics) {
    std::vector<std::string> names{"x",       "y",       "z",       "f_dc_0", "f_dc_1", "f_dc_2", "opacity",
                                   "scale_0", "scale_1", "scale_2", "rot_0",  "rot_1",  "rot_2",  "rot_3"};
    for (std::size_t k = 0; k < 3 * harmonics; ++k) names.push_back("f_rest_" + std::to_string(k));
    return names;
}

/// The columns of the named properties in a row of the file.
std::vector<std::size_t> placesOf(const std::string& path, const PlyLayout& layout,
                                  const std::vector<std::string>& names) {
    std::vector<std::size_t> places;
    for (const std::string& name : names) {
        const auto column = layout.columns.find(name);
        if (column == layout.columns.end()) fail(path, "has no property " + name);
        places.push_back(column->second);
    }
    return places;
}

/// values: in the order of columnsOf.
OracleGaussian gaussianOf(const std::vector<double>& values, std::size_t harmonics) {
    OracleGaussian gaussian;
    for (std::size_t k = 0; k < 3; ++k) {
        gaussian.mean[k] = values[kMean + k];
        gaussian.deviation[k] = std::exp(values[kScale + k]);
        gaussian.color[k] = 0.5 + kConstantHarmonic * values[kColor + k];
    }
    std::copy_n(values.begin() + kRotation, 4, gaussian.rotation.begin());
    gaussian.opacity = 1 / (1 + std::exp(-values[kOpacity]));
    gaussian.harmonics.resize(harmonics);
    for (std::size_t k = 0; k < harmonics; ++k) // files hold all of red, then of green, then of blue
        for (std::size_t c = 0; c < 3; ++c) gaussian.harmonics[k][c] = values[kPlainCount + c * harmonics + k];
    return gaussian;
}

double logitOf(double opacity) { return std::clamp(std::log(opacity / (1 - opacity)), -kLargestLogit, kLargestLogit); }

/// Values in the order of columnsOf.
std::vector<double> valuesOf(const OracleGaussian& gaussian, std::size_t harmonics) {
    std::vector<double> values(gaussian.mean.begin(), gaussian.mean.end());
    for (const double channel : gaussian.color) values.push_back((channel - 0.5) / kConstantHarmonic);
    values.push_back(logitOf(gaussian.opacity));
    for (const double deviation : gaussian.deviation) values.push_back(std::log(deviation));
    values.insert(values.end(), gaussian.rotation.begin(), gaussian.rotation.end());
    for (std::size_t c = 0; c < 3; ++c)
        for (std::size_t k = 0; k < harmonics; ++k)
            values.push_back(k < gaussian.harmonics.size() ? gaussian.harmonics[k][c] : 0.0);
    return values;
}

} // namespace

std::vector<OracleGaussian> readGaussianPly(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    if (!file) fail(path, "cannot be read");
    const PlyLayout layout = readPlyLayout(path, file);
    const std::size_t harmonics = harmonicsIn(layout);
    const std::vector<std::size_t> places = placesOf(path, layout, columnsOf(harmonics));
    std::vector<float> row(layout.columns.size());
    std::vector<double> values(places.size());
    std::vector<OracleGaussian> gaussians;
    for (std::size_t k = 0; k < layout.count; ++k) {
        if (!file.read(reinterpret_cast<char*>(row.data()), static_cast<std::streamsize>(row.size() * sizeof(float))))
            fail(path, "ends after " + std::to_string(k) + " Gaussians");
        std::transform(places.begin(), places.end(), values.begin(), [&](std::size_t place) { return row[place]; });
        gaussians.push_back(gaussianOf(values, harmonics));
    }
    return gaussians;
}

void writeGaussianPly(const std::string& path, const std::vector<OracleGaussian>& gaussians) {
    std::size_t harmonics = 0;
    for (const OracleGaussian& each : gaussians) harmonics = std::max(harmonics, each.harmonics.size());
    std::ofstream file(path, std::ios::binary);
    file << "ply\nformat binary_little_endian 1.0\nelement vertex " << gaussians.size() << '\n';
    for (const std::string& name : columnsOf(harmonics)) file << "property float " << name << '\n';
    file << "end_header\n";
    for (const OracleGaussian& each : gaussians) {
        const std::vector<double> values = valuesOf(each, harmonics);
        const std::vector<float> floats(values.begin(), values.end());
        file.write(reinterpret_cast<const char*>(floats.data()),
                   static_cast<std::streamsize>(floats.size() * sizeof(float)));
    }
    if (!file.flush()) fail(path, "cannot be written");
}

} // namespace pointrt::test
