// What the static program does without: each function fails as its library lets it fail, and HDF5 then says what it cannot do.
//
// Debian's HDF5 can read files from Amazon S3, with libcurl and libcrypto. Carom opens files of the machine alone, and a static
// libcurl would need static libraries of Kerberos, which Debian does not have. HDF5 also looks for filters of other programs in
// shared libraries; a static program would have to load those with a second C library.
//
// The functions have C's names, so that their parameters do not matter to the linker; none of them looks at one.

extern "C" {

/// curl_global_init returns CURLE_FAILED_INIT, with which HDF5 refuses to open a file of S3.
int curl_global_init(long) { return 2; }
void curl_global_cleanup() {}
void* curl_easy_init() { return nullptr; }
void curl_easy_cleanup(void*) {}
int curl_easy_setopt(void*, int, ...) { return 2; }
int curl_easy_perform(void*) { return 2; }
void* curl_slist_append(void*, const char*) { return nullptr; }
void curl_slist_free_all(void*) {}

const void* EVP_sha256() { return nullptr; }
unsigned char* HMAC(const void*, const void*, int, const unsigned char*, unsigned long, unsigned char*, unsigned int*) {
  return nullptr;
}
unsigned char* SHA256(const unsigned char*, unsigned long, unsigned char*) { return nullptr; }

/// __wrap_dlopen is what HDF5 calls in place of dlopen (--wrap), and finds no shared library.
void* __wrap_dlopen(const char*, int) { return nullptr; }
}
