/* SPDX-License-Identifier: MIT
 *
 * password - stores a hash, compares, and makes whoever guesses wait.
 */
#include "ladderd/password.h"

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
	if (fd < 0 && errno == ENOENT)
		return;
	password->set = true;
	if (fd >= 0) {
		len = read(fd, password->hash, sizeof(password->hash) - 1);
		close(fd);
	}
	password->hash[len > 0 ? len : 0] = '\0';
	password->hash[strcspn(password->hash, "\n")] = '\0';
	if (len <= 0)
		fprintf(stderr, "ladderd: %s cannot be read: nobody can read the program back\n", path);
}

enum refusal password_check(struct password *password, const char *text, int64_t now_ns,
			    char *detail, size_t size)
{
	int64_t wait_s;

	if (!password->set)
		return REFUSAL_NONE;
	if (!crypt_can())
		return REFUSAL_NO_SERVICE;
	if (now_ns < password->not_before_ns) {
		snprintf(detail, size, "%lld", (long long)((password->not_before_ns - now_ns) / SECOND + 1));
		return REFUSAL_WAIT;
	}
	if (crypt_fits(text, password->hash)) {
		password->wrong = 0;
		return REFUSAL_NONE;
	}
	wait_s = password->wrong < 6 ? INT64_C(1) << password->wrong : WAIT_MOST;
	password->wrong++;
	password->not_before_ns = now_ns + wait_s * SECOND;
	return REFUSAL_WRONG;
}

/* So that a power cut does not undo it. */
static void sync_folder(const char *path)
{
	const int folder = open(path, O_RDONLY | O_DIRECTORY | O_CLOEXEC);

	if (folder < 0)
		return;
	fsync(folder);
	close(folder);
}

/* Readable by this user only, and whole or not at all. @hash "": no password. */
static int store(const struct password *password, const char *hash)
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
		sync_folder(password->folder);
		return 0;
	}
	fd = open(fresh, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0600);
	if (fd < 0)
		return -errno;
	if (write(fd, hash, len) != (ssize_t)len || write(fd, "\n", 1) != 1 || fsync(fd) != 0)
		error = errno ? -errno : -EIO;
	close(fd);
	if (!error && rename(fresh, path) != 0)
		error = -errno;
	if (error) {
		unlink(fresh);
		return error;
	}
	sync_folder(password->folder);
	return 0;
}

enum refusal password_change(struct password *password, const char *old, const char *text,
			     int64_t now_ns, char *detail, size_t size)
{
	char hash[PASSWORD_HASH] = "";
	enum refusal refusal;
	int error;

	if (!crypt_can())
		return REFUSAL_NO_SERVICE;
	if (!password->folder)
		return REFUSAL_NO_STORE;
	refusal = password_check(password, old, now_ns, detail, size);
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
