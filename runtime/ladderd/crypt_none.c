/* SPDX-License-Identifier: MIT
 *
 * crypt_none - a ladderd without libcrypt: no password can be set, and none fits.
 */
#include "ladderd/password.h"

bool crypt_can(void)
{
	return false;
}

bool crypt_make(const char *text, char *out)
{
	(void)text, (void)out;
	return false;
}

enum crypt_end crypt_compare(const char *text, const char *hash)
{
	(void)text, (void)hash;
	return CRYPT_DIFFERS;
}
