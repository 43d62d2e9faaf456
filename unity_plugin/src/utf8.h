#ifndef DPE_UNITY_UTF8_H_
#define DPE_UNITY_UTF8_H_

namespace dpe::c {

// Whether a text that ends with a zero byte is UTF-8 (RFC 3629: no overlong forms, no
// surrogates, nothing above U+10FFFF).
bool IsUtf8(const char* text);

}  // namespace dpe::c

#endif  // DPE_UNITY_UTF8_H_
