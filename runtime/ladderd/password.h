/* SPDX-License-Identifier: MIT
 *
 * password - the program password of a board: without it nobody reads the program back.
 *
 * The file `password` in the folder of slots has its hash, made by crypt(3) with yescrypt. After
 * a wrong one the next try of that user must wait, in whichever session; other users need not.
 * Used by the link thread.
 */
#ifndef LADDERD_PASSWORD_H
#define LADDERD_PASSWORD_H

#include "online/server.h"

#define PASSWORD_HASH 128
#define PASSWORD_GUESSERS 16 /* users at most who may have to wait           */

/* A user whose last try was wrong. */
struct guesser {
	uint32_t who;
	unsigned wrong;        /* tries in a row; 0: no user                  */
	int64_t not_before_ns; /* of the next try                             */
};

struct password {
	const char *folder;    /* NULL: no --slots                            */
	bool set;
	char hash[PASSWORD_HASH];
	struct guesser guesser[PASSWORD_GUESSERS];
};

/** password_load - Scan-safe: no; so are all functions. A file that cannot be read counts as a
 * password that nobody knows. */
void password_load(struct password *password, const char *folder);
/** password_check, password_change - as in struct server_password. */
enum refusal password_check(struct password *password, uint32_t who, const char *text,
			    int64_t now_ns, char *detail, size_t size);
enum refusal password_change(struct password *password, uint32_t who, const char *old,
			     const char *text, int64_t now_ns, char *detail, size_t size);

/* ---- crypt_yescrypt.c, or crypt_none.c where there is no libcrypt ---- */

/** crypt_can - whether hashes can be made here. */
bool crypt_can(void);
/** crypt_make - @out: PASSWORD_HASH bytes. Fails: false: no memory. */
bool crypt_make(const char *text, char *out);
enum crypt_end { CRYPT_FITS, CRYPT_DIFFERS, CRYPT_NO_MEMORY };
/** crypt_compare - whether @text has this hash; a damaged hash fits nothing. */
enum crypt_end crypt_compare(const char *text, const char *hash);
#endif
