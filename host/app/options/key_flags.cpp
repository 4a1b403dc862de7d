#include "app/options/key_flags.hpp"

namespace nook {

std::string flag_type(const KeyInfo& key) {
  return key.domain.form == Domain::Form::integer  ? "INT"
         : key.domain.form == Domain::Form::number ? "NUMBER"
                                                   : "WORD";
}

}  // namespace nook
