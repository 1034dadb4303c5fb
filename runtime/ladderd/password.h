/* SPDX-License-Identifier: MIT
 *
 * password - the program password of a board: without it nobody reads the program back.
 *
 * The file `password` in the folder of slots has its hash, made by crypt(3) with yescrypt. After
 * a wrong one the next try must wait, whoever makes it. Used by the link thread.
 */
#ifndef LADDERD_PASSWORD_H
#define LADDERD_PASSWORD_H

#include "online/server.h"

#define PASSWORD_HASH 128

struct password {
	const char *folder;    /* NULL: no --slots                            */
	bool set;
	char hash[PASSWORD_HASH];
	int64_t not_before_ns; /* of the next try                             */
	unsigned wrong;        /* tries in a row                              */
};

/** password_load - Scan-safe: no; so are all functions. A file that cannot be read counts as a
 * password that nobody knows. */
void password_load(struct password *password, const char *folder);
/** password_check, password_change - as in struct server_password. */
enum refusal password_check(struct password *password, const char *text, int64_t now_ns,
			    char *detail, size_t size);
enum refusal password_change(struct password *password, const char *old, const char *text,
			     int64_t now_ns, char *detail, size_t size);

/* ---- crypt_yescrypt.c, or crypt_none.c where there is no libcrypt ---- */

/** crypt_can - whether hashes can be made here. */
bool crypt_can(void);
/** crypt_make - @out: PASSWORD_HASH bytes. Fails: false: no memory. */
bool crypt_make(const char *text, char *out);
/** crypt_fits - whether @text has this hash. Fails: false. */
bool crypt_fits(const char *text, const char *hash);
#endif
