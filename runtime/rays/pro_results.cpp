// SPDX-License-Identifier: Apache-2.0
#include "runtime/rays/pro_results.h"

#include <algorithm>
#include <cstring>
#include <optional>
#include <utility>

#include "format/base/error.h"
#include "format/base/require_pro.h"
#include "pointrt/pro.hpp"
#include "runtime/cast/describe_instances.h"
#include "runtime/scene_io/scene_file.h"

namespace pointrt {
namespace {

class ProSink final : public PointSink {
public:
    ProSink(std::string output, const std::string& scan, const std::vector<PointColumn>& results)
        : output_(std::move(output)), results_(results), values_(results.size()) {
        try {
            file_.emplace(scan, PRO_OPEN_SKIP_CHECKSUMS);
        } catch (const ProError& error) {
            throw Error(exitCodeOf(error.result), error.what());
        }
        if (file_->gaussians())
            throw Error(ExitCode::kBadInput, scan + ": holds Gaussians, which have no attributes; write a .ply");
        attributes_ = file_->attributes();
        std::erase_if(attributes_, [&](const pro_attribute& each) { return isResult(each.name); });
        if (attributes_.size() + results_.size() > PRO_ATTRIBUTE_MAX)
            throw Error(ExitCode::kBadInput, scan + ": has too many attributes to add the results; write a .ply");
    }

    void add(const PointBlock& block) override {
        const std::size_t first = block.columns.size() - results_.size();
        for (std::size_t k = 0; k < results_.size(); ++k)
            values_[k].insert(values_[k].end(), block.columns[first + k].begin(), block.columns[first + k].end());
    }

    void finish() override {
        for (std::size_t k = 0; k < results_.size(); ++k) attributes_.push_back(attributeOf(k));
        pro_content content{};
        content.info = &file_->info();
        content.view = &file_->view();
        content.index = file_->index();
        content.world = &file_->world();
        content.attributes = attributes_.data();
        content.attribute_count = static_cast<std::uint32_t>(attributes_.size());
        content.sampling = &file_->sampling();
        pro_message message{};
        const pro_result result = pro_write_content(output_.c_str(), &content, 1, &message);
        if (result != PRO_OK) throw Error(exitCodeOf(result), output_ + ": " + message.text);
    }

private:
    bool isResult(const std::string& name) const {
        return std::any_of(results_.begin(), results_.end(),
                           [&](const PointColumn& column) { return column.name == name; });
    }

    pro_attribute attributeOf(std::size_t result) const {
        const PointColumn& column = results_[result];
        pro_attribute attribute{};
        std::strncpy(attribute.name, column.name.c_str(), PRO_ATTRIBUTE_NAME_MAX);
        attribute.type = column.type;
        attribute.components = column.components;
        attribute.values = values_[result].data();
        return attribute;
    }

    std::string output_;
    std::vector<PointColumn> results_;
    std::vector<std::vector<std::byte>> values_; ///< values of each result
    std::optional<ProFile> file_;
    std::vector<pro_attribute> attributes_;
};

} // namespace

bool isProOutput(const std::string& output) { return output.ends_with(".pro"); }

std::string scanOfResults(const std::string& points, const std::vector<std::string>& scene) {
    const Error refusal(ExitCode::kBadUsage, "-o: a .pro output needs points from a single .pro scan; write a .ply");
    if (!points.empty() && !isSceneOrSet(points) && !beginsAsPro(points)) throw refusal;
    const InstanceList list = describeInstances(points.empty() ? scene : std::vector{points});
    if (list.scene_instances.size() != 1 || list.scene_instances.front().set || list.files.size() != 1) throw refusal;
    return list.files.front().path;
}

std::unique_ptr<PointSink> openProSink(const std::string& output, const std::string& scan,
                                       const std::vector<PointColumn>& results) {
    return std::make_unique<ProSink>(output, scan, results);
}

} // namespace pointrt
