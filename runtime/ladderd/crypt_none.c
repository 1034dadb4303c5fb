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

bool crypt_fits(const char *text, const char *hash)
{
	(void)text, (void)hash;
	return false;
}
