/* SPDX-License-Identifier: MIT
 *
 * iio_calls - finds the functions of libiio in the library that is installed; see iio_calls.h.
 *
 * It loads nothing else: programs are data.
 */
#include "hal/iio_calls.h"

#include <dlfcn.h>
#include <iio.h>
#include <string.h>

#define LIBRARY "libiio.so.0" /* its interface up to version 0.26; that of 1.0 is another one */

/* ISO C has no cast from the object pointer of dlsym() to a function. */
static bool find(void *library, const char *name, void *out)
{
	void *found = dlsym(library, name);

	memcpy(out, &found, sizeof(found));
	return found;
}

bool iio_calls_find(struct iio_calls *out)
{
	/* It stays, because a device that went is searched for again and again. */
	void *library = dlopen(LIBRARY, RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE);
	bool good = library;

	/* The assignment is not done; it makes the compiler compare the types. */
#define CALL(type, name, ...) \
	(void)sizeof(out->name = iio_##name); \
	good = good && find(library, "iio_" #name, &out->name);
	IIO_CALLS(CALL)
#undef CALL
	if (library)
		dlclose(library);
	return good;
}
