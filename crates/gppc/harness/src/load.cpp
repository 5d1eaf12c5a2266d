#include "load.h"

#include <dlfcn.h>
#include <stdexcept>

namespace harness {

namespace {

template <class Function> Function *find(void *library, const char *name) {
  return reinterpret_cast<Function *>(dlsym(library, name));
}

template <class Function> void need(void *library, const char *name, Function *&function) {
  function = find<Function>(library, name);
  if (function == nullptr) {
    throw std::runtime_error(std::string("the library has no ") + name);
  }
}

} // namespace

Library::Library(const std::string &file) {
  // A name without a slash would be looked for elsewhere.
  std::string at = file.find('/') == std::string::npos ? "./" + file : file;
  void *library = dlopen(at.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (library == nullptr) {
    throw std::runtime_error(dlerror());
  }
  need(library, "gppc_preprocess_init_map", preprocess);
  need(library, "gppc_search_init", init);
  need(library, "gppc_map_change", change);
  need(library, "gppc_get_path", path);
  need(library, "gppc_free_data", free);
  need(library, "gppc_get_name", name);
  tags = find<int(int)>(library, "gppc_scenario_tags");
}

} // namespace harness
