#include "emulator/model_file/model_files.h"

#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "base/files/content_kind.h"
#include "base/files/file_claims.h"
#include "base/files/file_error.h"
#include "base/files/text_file.h"
#include "base/text/one_line.h"
#include "emulator/device/model.h"
#include "emulator/model_file/model_reader.h"
#include "emulator/models/imported/description.h"
#include "emulator/models/imported/model.h"
#include "emulator/world/bench_file/yaml_fields.h"

namespace understudy::emulator::model_file {

DescribedModels::DescribedModels(ModelList house) : house_(house) {}
DescribedModels::~DescribedModels() = default;

const Model& DescribedModels::load(const std::string& path, std::vector<FileClaim>& files) {
  const auto text = read_text_file(path);
  if (!text) throw FileError(path + ": model: " + text.why + "; expected a model file");
  if (const std::string why = is_another_kind(*text, ContentKind::model); !why.empty()) {
    throw FileError({path, 1, 1}, "model: " + why);
  }
  files.push_back({path, "the model file " + quoted(path)});
  return read(*text, path, true, files);
}

const Model& DescribedModels::parse(const std::string& text, const std::string& name) {
  std::vector<FileClaim> none;
  return read(text, name, false, none);
}

std::vector<FileError::Diagnostic> DescribedModels::remarks_on(const Model& model) const {
  const std::lock_guard lock(mutex_);
  const auto found = models_.find(std::string(model.description));
  return found == models_.end() ? std::vector<FileError::Diagnostic>() : found->second->description().remarks;
}

const Model& DescribedModels::read(const std::string& text, const std::string& name, bool may_read,
                                   std::vector<FileClaim>& files) {
  models::imported::Description described = read_model(text, name, may_read, files);
  for (const ListedModel& model : house_) {
    if (model.name() != described.name) continue;
    world::YamlFields::parse(text, name, "model", "a model")
        .at("model")
        .fail(quoted(described.name) + " is a built-in model; expected another name");
  }
  const std::lock_guard lock(mutex_);
  auto& model = models_[described.text];
  if (model == nullptr) model = std::make_unique<models::imported::ImportedModel>(std::move(described));
  return model->model();
}

}  // namespace understudy::emulator::model_file
