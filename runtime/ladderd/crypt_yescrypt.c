/* SPDX-License-Identifier: MIT
 *
 * crypt_yescrypt - hashes of libcrypt (libxcrypt). Its memory is wiped before it is freed.
 */
#define _GNU_SOURCE /* explicit_bzero() */
#include "ladderd/password.h"

#include <crypt.h>
#include <stdlib.h>
#include <string.h>

bool crypt_can(void)
{
	return true;
}

/* crypt_rn() of a struct that is too large for a stack. Fails: false: no memory, or the setting
 * is none; errno is the same for both. */
static bool hash(const char *text, const char *setting, char *out)
{
	struct crypt_data *data = calloc(1, sizeof(*data));
	const char *made = data ? crypt_rn(text, setting, data, sizeof(*data)) : NULL;
	const bool good = made && *made != '*' && strlen(made) < PASSWORD_HASH;

	if (good)
		memcpy(out, made, strlen(made) + 1);
	if (data)
		explicit_bzero(data, sizeof(*data));
	free(data);
	return good;
}

bool crypt_make(const char *text, char *out)
{
	char setting[CRYPT_GENSALT_OUTPUT_SIZE];

	return crypt_gensalt_rn("$y$", 0, NULL, 0, setting, sizeof(setting)) &&
	       hash(text, setting, out);
}

enum crypt_end crypt_compare(const char *text, const char *wanted)
{
	char made[PASSWORD_HASH];
	unsigned char differs = 0;
	size_t len = strlen(wanted);

	/* If a new hash can be made, @wanted is damaged. */
	if (!hash(text, wanted, made))
		return crypt_make(text, made) ? CRYPT_DIFFERS : CRYPT_NO_MEMORY;
	if (strlen(made) != len)
		return CRYPT_DIFFERS;
	for (size_t i = 0; i < len; i++)
		differs |= (unsigned char)(made[i] ^ wanted[i]);
	return differs ? CRYPT_DIFFERS : CRYPT_FITS;
}
