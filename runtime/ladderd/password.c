/* SPDX-License-Identifier: MIT
 *
 * password - stores a hash, compares, and makes a user wait after a wrong password.
 */
#include "ladderd/password.h"
#include "ladderd/disk.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#define SECOND    INT64_C(1000000000)
#define WAIT_MOST 64 /* seconds */

static bool path_of(const struct password *password, const char *name, char *out, size_t size)
{
	return snprintf(out, size, "%s/%s", password->folder, name) < (int)size;
}

void password_load(struct password *password, const char *folder)
{
	char path[320];
	ssize_t len = -1;
	int fd;

	memset(password, 0, sizeof(*password));
	password->folder = folder;
	if (!folder || !path_of(password, "password", path, sizeof(path)))
		return;
	fd = open(path, O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK);
	if (fd < 0 && errno != ENOENT) /* it may be of the moment */
		fd = open(path, O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK);
	if (fd < 0 && errno == ENOENT)
		return;
	password->set = true;
	if (fd >= 0) {
		len = read(fd, password->hash, sizeof(password->hash) - 1);
		if (len < 0)
			len = read(fd, password->hash, sizeof(password->hash) - 1);
		close(fd);
	}
	password->hash[len > 0 ? len : 0] = '\0';
	password->hash[strcspn(password->hash, "\n")] = '\0';
	if (!*password->hash)
		fprintf(stderr, "ladderd: %s cannot be read: nobody can read the program back\n", path);
}

/* The row of @who; else a free one, or that of the user who has waited longest ago. So a user who
 * guesses has one row, however often he tries. */
static struct guesser *guesser_of(struct password *password, uint32_t who)
{
	struct guesser *found = &password->guesser[0];

	for (int i = 0; i < PASSWORD_GUESSERS; i++) {
		struct guesser *it = &password->guesser[i];

		if (it->wrong && it->who == who)
			return it;
		if (found->wrong && (!it->wrong || it->not_before_ns < found->not_before_ns))
			found = it;
	}
	return found;
}

enum refusal password_check(struct password *password, uint32_t who, const char *text,
			    int64_t now_ns, char *detail, size_t size)
{
	struct guesser *guesser = guesser_of(password, who);
	int64_t wait_s;

	if (!password->set)
		return REFUSAL_NONE;
	if (!crypt_can())
		return REFUSAL_NO_SERVICE;
	/* Also if other users have all rows: then one of them has just been wrong. */
	if (guesser->wrong && now_ns < guesser->not_before_ns) {
		snprintf(detail, size, "%lld", (long long)((guesser->not_before_ns - now_ns) / SECOND + 1));
		return REFUSAL_WAIT;
	}
	if (!guesser->wrong || guesser->who != who)
		*guesser = (struct guesser){ .who = who };
	switch (crypt_compare(text, password->hash)) {
	case CRYPT_FITS:
		guesser->wrong = 0;
		return REFUSAL_NONE;
	case CRYPT_NO_MEMORY:
		return REFUSAL_MEMORY; /* nobody knows whether it was wrong */
	case CRYPT_DIFFERS:
		break;
	}
	wait_s = guesser->wrong < 6 ? INT64_C(1) << guesser->wrong : WAIT_MOST;
	guesser->wrong++;
	guesser->not_before_ns = now_ns + wait_s * SECOND;
	return REFUSAL_WRONG;
}

/* Readable by this user only, and whole or not at all. @hash "": no password. */
static int try_to_store(const struct password *password, const char *hash)
{
	char path[320], fresh[320];
	const size_t len = strlen(hash);
	int fd, error = 0;

	if (!path_of(password, "password", path, sizeof(path)) ||
	    !path_of(password, "password.new", fresh, sizeof(fresh)))
		return -ENAMETOOLONG;
	unlink(fresh);
	if (!len) {
		if (unlink(path) != 0 && errno != ENOENT)
			return -errno;
		return disk_sync_folder(password->folder);
	}
	fd = open(fresh, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0600);
	if (fd < 0)
		return -errno;
	error = disk_write(fd, hash, len, 0);
	if (!error)
		error = disk_write(fd, "\n", 1, (off_t)len);
	if (!error && fsync(fd) != 0)
		error = -errno;
	close(fd);
	if (!error && rename(fresh, path) != 0)
		error = -errno;
	if (error) {
		unlink(fresh);
		return error;
	}
	/* It has its name now, so it is the password, also if a power cut could still undo it. */
	if (disk_sync_folder(password->folder) != 0)
		fprintf(stderr, "ladderd: the new program password may not survive a power cut\n");
	return 0;
}

/* A disk may fail once. */
static int store(const struct password *password, const char *hash)
{
	const int error = try_to_store(password, hash);

	return error ? try_to_store(password, hash) : 0;
}

enum refusal password_change(struct password *password, uint32_t who, const char *old,
			     const char *text, int64_t now_ns, char *detail, size_t size)
{
	char hash[PASSWORD_HASH] = "";
	enum refusal refusal;
	int error;

	if (!crypt_can())
		return REFUSAL_NO_SERVICE;
	if (!password->folder)
		return REFUSAL_NO_STORE;
	refusal = password_check(password, who, old, now_ns, detail, size);
	if (refusal != REFUSAL_NONE)
		return refusal;
	if (*text && !crypt_make(text, hash))
		return REFUSAL_MEMORY;
	error = store(password, hash);
	if (error) {
		snprintf(detail, size, "%s", strerror(-error));
		return REFUSAL_DISK;
	}
	password->set = *text;
	memcpy(password->hash, hash, sizeof(hash));
	return REFUSAL_NONE;
}
