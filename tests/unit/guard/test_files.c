/* SPDX-License-Identifier: MIT
 *
 * test_files - safe numbers go to the files of the devices that had them, under whatever number the kernel shows these
 * now; never to another device. The class of a kernel stands in a folder of its own: class/pwm/pwmchip0 is a link to
 * devices/A/pwm/pwmchip0.
 */
#define _GNU_SOURCE
#include "guard/files.h"

#include "tests/tap.h"

#include <errno.h>
#include <ftw.h>
#include <stdarg.h>
#include <sys/stat.h>
#include <unistd.h>

#define PATH 400

static char root[64];

static void path_of(char out[PATH], const char *format, va_list args)
{
	const int len = snprintf(out, PATH, "%s/", root);

	vsnprintf(out + len, (size_t)(PATH - len), format, args);
}

static int drop_one(const char *path, const struct stat *stat, int type, struct FTW *at)
{
	(void)stat, (void)type, (void)at;
	return remove(path);
}

static void fresh(void)
{
	if (root[0])
		nftw(root, drop_one, 20, FTW_DEPTH | FTW_PHYS);
	snprintf(root, sizeof(root), "/tmp/guard_files_XXXXXX");
	if (!mkdtemp(root))
		root[0] = '\0';
}

/* Folders on the way to a path. */
static void make_way(char *path)
{
	for (char *at = strchr(path + strlen(root) + 1, '/'); at; at = strchr(at + 1, '/')) {
		*at = '\0';
		mkdir(path, 0755);
		*at = '/';
	}
}

__attribute__((format(printf, 2, 3)))
static void spew(const char *text, const char *format, ...)
{
	char path[PATH];
	va_list args;
	FILE *file;

	va_start(args, format);
	path_of(path, format, args);
	va_end(args);
	make_way(path);
	file = fopen(path, "w");
	CHECK(file != NULL);
	if (!file)
		return;
	fputs(text, file);
	fclose(file);
}

/* Does a file say that? */
__attribute__((format(printf, 2, 3)))
static bool has(const char *text, const char *format, ...)
{
	char path[PATH], got[64] = "";
	va_list args;
	FILE *file;

	va_start(args, format);
	path_of(path, format, args);
	va_end(args);
	file = fopen(path, "r");
	if (!file)
		return false;
	got[fread(got, 1, sizeof(got) - 1, file)] = '\0';
	fclose(file);
	return strcmp(got, text) == 0;
}

/* A chip at a place, with this number and this name of its device; "": it has none. */
static void plug(const char *place, int number, const char *name)
{
	char from[PATH], to[PATH];

	spew("0", "devices/%s/pwm/pwmchip%d/duty", place, number);
	if (*name)
		spew(name, "devices/%s/name", place);
	snprintf(to, sizeof(to), "../../devices/%s", place);
	snprintf(from, sizeof(from), "%s/devices/%s/pwm/pwmchip%d/device", root, place, number);
	snprintf(to, sizeof(to), "%s/devices/%s", root, place);
	CHECK(symlink(to, from) == 0);
	spew("", "class/pwm/.here");
	snprintf(from, sizeof(from), "%s/class/pwm/pwmchip%d", root, number);
	snprintf(to, sizeof(to), "../../devices/%s/pwm/pwmchip%d", place, number);
	CHECK(symlink(to, from) == 0);
}

static void unplug(const char *place, int number)
{
	char path[PATH];

	snprintf(path, sizeof(path), "%s/class/pwm/pwmchip%d", root, number);
	unlink(path);
	snprintf(path, sizeof(path), "%s/devices/%s", root, place);
	nftw(path, drop_one, 20, FTW_DEPTH | FTW_PHYS);
}

/* A packet of files. */
struct list {
	struct guard_files files;
	size_t len;
};

__attribute__((format(printf, 3, 4)))
static void add(struct list *list, int64_t safe, const char *format, ...)
{
	char path[PATH];
	va_list args;

	va_start(args, format);
	path_of(path, format, args);
	va_end(args);
	memcpy(list->files.record + list->len, &safe, sizeof(safe));
	list->len += sizeof(safe);
	memcpy(list->files.record + list->len, path, strlen(path) + 1);
	list->len += strlen(path) + 1;
	list->files.head.count++;
}

/* What the guard says goes into a file from hear() to heard(). */
struct ear {
	FILE *file;
	int before;
};

static struct ear hear(void)
{
	struct ear ear = { .file = tmpfile(), .before = dup(STDERR_FILENO) };

	if (ear.file)
		dup2(fileno(ear.file), STDERR_FILENO);
	return ear;
}

static void heard(struct ear *ear, char told[400])
{
	dup2(ear->before, STDERR_FILENO);
	close(ear->before);
	told[0] = '\0';
	if (!ear->file)
		return;
	rewind(ear->file);
	told[fread(told, 1, 399, ear->file)] = '\0';
	fclose(ear->file);
}

/* What files_write() says, and whether all are written. */
static bool write_all(struct files *files, char told[400])
{
	struct ear ear = hear();
	const bool good = files_write(files);

	heard(&ear, told);
	return good;
}

/* What is done to the chips between the moment when they are learned and the one when ladderd has died. */
struct change {
	const char *what;
	const char *name;      /* of the chip at A                            */
	const char *twin;      /* name of another one at B; NULL: there is none */
	const char *moved;     /* where the chip is then; NULL: it is gone    */
	int number;            /* its number then                             */
	const char *other;     /* name of a stranger with its old number, at C; NULL: there is none */
	bool found;
};

static const struct change changes[] = {
	{ "nothing has changed", "motor", NULL, "A", 0, NULL, true },
	{ "nothing has changed, without a name", "", NULL, "A", 0, NULL, true },
	{ "another number", "motor", NULL, "A", 5, NULL, true },
	{ "another number, a stranger has the old one", "motor", NULL, "A", 5, "fan", true },
	{ "another number, without a name", "", NULL, "A", 5, "fan", true },
	{ "another place, with its name", "motor", NULL, "D", 5, NULL, true },
	{ "another place, a stranger has the old number", "motor", NULL, "D", 5, "fan", true },
	{ "another place, without a name", "", NULL, "D", 5, NULL, false },
	{ "another place, but the name is that of two", "motor", "motor", "D", 5, NULL, false },
	{ "the same place, and the name is that of two", "motor", "motor", "A", 5, NULL, true },
	{ "another place, and a second one of its name has come", "motor", NULL, "D", 5, "motor", true },
	{ "it is gone", "motor", NULL, NULL, 0, NULL, false },
	{ "it is gone, a stranger has its number", "motor", NULL, NULL, 0, "fan", false },
	{ "it is gone, its twin is there", "motor", "motor", NULL, 0, NULL, false },
};

static void test_a_change(const struct change *change)
{
	static struct files files;
	struct list list = { .len = 0 };
	char told[400];
	bool good, right;

	fresh();
	plug("A", 0, change->name);
	if (change->twin)
		plug("B", 1, change->twin);
	files_begin(&files);
	add(&list, 45, "class/pwm/pwmchip0/duty");
	files_know(&files, &list.files);
	if (!change->moved || strcmp(change->moved, "A") != 0 || change->number) {
		unplug("A", 0);
		if (change->other)
			plug("C", 0, change->other);
		if (change->moved)
			plug(change->moved, change->number, change->name);
	}
	good = write_all(&files, told);
	/* Two of one name that came later: the one with the old number has it, as nobody can know better. */
	right = change->other && strcmp(change->other, change->name) == 0 ?
		has("45\n", "class/pwm/pwmchip0/duty") && has("0", "class/pwm/pwmchip%d/duty", change->number) :
		!change->found || has("45\n", "class/pwm/pwmchip%d/duty", change->number);
	if (change->twin)
		right = right && has("0", "class/pwm/pwmchip1/duty");
	if (change->other && strcmp(change->other, change->name) != 0)
		right = right && has("0", "class/pwm/pwmchip0/duty");
	if (!change->found)
		right = right && strstr(told, "pwmchip0/duty\" is not safe: No such device; the guard tries again\n");
	if (!CHECK_AS(good == change->found && right && (good ? !*told : *told), change->what))
		printf("# %d %s\n", good, told);
}

static void test_again(void)
{
	static struct files files;
	struct list list = { .len = 0 };
	char told[400];

	fresh();
	plug("A", 0, "motor");
	files_begin(&files);
	CHECK_AS(files_write(&files), "no file: all are safe");
	add(&list, -7, "class/pwm/pwmchip0/later");
	add(&list, INT64_MAX, "class/pwm/pwmchip0/duty");
	add(&list, 3, "other/file");
	files_know(&files, &list.files);
	CHECK(!write_all(&files, told) && strstr(told, "pwmchip0/later\" is not safe: No such file or directory; the guard tries again\n"));
	CHECK_AS(has("9223372036854775807\n", "class/pwm/pwmchip0/duty"), "the others are written all the same");
	CHECK_AS(!write_all(&files, told) && !*told, "that is told once");
	spew("", "devices/A/pwm/pwmchip0/later");
	spew("", "other/file");
	CHECK(write_all(&files, told) && !*told && has("-7\n", "class/pwm/pwmchip0/later") && has("3\n", "other/file"));
	spew("", "other/file");
	CHECK_AS(files_write(&files) && has("", "other/file"), "each is written once");
}

/* Beside the files of a map those of another one, which is about to be opened; then that one is dropped. */
static void test_two_maps(void)
{
	static struct files files;
	struct list one = { .len = 0 }, two = { .len = 0 }, none = { .len = 0 };
	char told[400];

	fresh();
	plug("A", 0, "motor");
	plug("B", 1, "fan");
	add(&one, 11, "class/pwm/pwmchip0/duty");
	add(&two, 22, "class/pwm/pwmchip1/duty");
	files_begin(&files);
	files_know(&files, &one.files);
	files_more(&files, &two.files);
	CHECK(write_all(&files, told) && has("11\n", "class/pwm/pwmchip0/duty") && has("22\n", "class/pwm/pwmchip1/duty"));
	spew("0", "class/pwm/pwmchip0/duty");
	spew("0", "class/pwm/pwmchip1/duty");
	files_more(&files, &none.files);
	CHECK(write_all(&files, told) && has("11\n", "class/pwm/pwmchip0/duty") && has("0", "class/pwm/pwmchip1/duty"));
	files_know(&files, &two.files);
	CHECK(write_all(&files, told) && has("22\n", "class/pwm/pwmchip1/duty"));
	files_know(&files, &none.files);
	spew("0", "class/pwm/pwmchip1/duty");
	CHECK_AS(write_all(&files, told) && has("0", "class/pwm/pwmchip1/duty"), "a map without such outputs");
}

/* More devices than it knows, and a device that gets a number with which its path is too long. */
static void test_room(void)
{
	static struct files files;
	struct list list = { .len = 0 }, more = { .len = 0 };
	struct ear ear;
	char told[400], longest[GUARD_PATH];
	int written = 0;

	fresh();
	for (int i = 0; i < 65; i++) {
		plug("A", i, "");
		add(i < 40 ? &list : &more, 5, "class/pwm/pwmchip%d/duty", i);
	}
	files_begin(&files);
	files_know(&files, &list.files);
	write_all(&files, told);
	CHECK(!*told);
	ear = hear();
	files_more(&files, &more.files);
	heard(&ear, told);
	CHECK(strstr(told, "/class/pwm/pwmchip64/duty\" is not made safe: the guard has no room for it\n"));
	CHECK_AS(!write_all(&files, told), "and so are not all safe");
	for (int i = 0; i < 65; i++)
		written += has("5\n", "class/pwm/pwmchip%d/duty", i);
	CHECK(written == PLACES);
	files_more(&files, &(struct guard_files){ .head = { .count = 0 } });
	CHECK_AS(write_all(&files, told), "without it all are");

	fresh();
	memset(longest, 'x', sizeof(longest));
	longest[GUARD_PATH - 1 - strlen(root) - strlen("/class/pwm/pwmchip0/")] = '\0';
	plug("A", 0, "motor");
	spew("", "devices/A/pwm/pwmchip0/%s", longest);
	list = (struct list){ .len = 0 };
	add(&list, 6, "class/pwm/pwmchip0/%s", longest);
	files_know(&files, &list.files);
	CHECK(write_all(&files, told) && has("6\n", "class/pwm/pwmchip0/%s", longest));
	files_know(&files, &list.files);
	unplug("A", 0);
	plug("A", 10, "motor");
	CHECK(!write_all(&files, told) && strstr(told, "is not safe: File name too long; the guard tries again\n"));
	unplug("A", 10);
	fresh();
	files.told = false;
	CHECK_AS(!write_all(&files, told) && strstr(told, "No such file or directory"), "the class is gone");
}

/* Entries that are no links, as in other folders of the kernel: the name alone tells which one it is. */
static void test_no_links(void)
{
	static struct files files;
	struct list list = { .len = 0 };
	char told[400], from[PATH], to[PATH];

	fresh();
	spew("motor\n", "class/hwmon/hwmon0/name");
	spew("0", "class/hwmon/hwmon0/pwm1");
	spew("0", "class/iio/iio:device3/out");
	spew("0", "class/iio/iio:device/out");
	files_begin(&files);
	add(&list, 8, "class/hwmon/hwmon0/pwm1");
	add(&list, 9, "class/iio/iio:device3/out");
	add(&list, 10, "class/iio/iio:device/out");
	files_know(&files, &list.files);
	snprintf(from, sizeof(from), "%s/class/hwmon/hwmon0", root);
	snprintf(to, sizeof(to), "%s/class/hwmon/hwmon12", root);
	CHECK(rename(from, to) == 0);
	spew("fan\n", "class/hwmon/hwmon0/name");
	spew("0", "class/hwmon/hwmon0/pwm1");
	spew("motor\n", "class/hwmon/hwmonx/name");
	CHECK(write_all(&files, told) && !*told);
	CHECK(has("8\n", "class/hwmon/hwmon12/pwm1") && has("0", "class/hwmon/hwmon0/pwm1"));
	CHECK_AS(has("9\n", "class/iio/iio:device3/out") && has("10\n", "class/iio/iio:device/out"), "without a name: as they were");
	spew("motor\n", "class/hwmon/hwmon7/name");
	spew("0", "class/hwmon/hwmon7/pwm1");
	spew("0", "class/hwmon/hwmon12/pwm1");
	files.written = false;
	CHECK_AS(!write_all(&files, told) && has("0", "class/hwmon/hwmon7/pwm1") && has("0", "class/hwmon/hwmon12/pwm1"),
		 "two of its name with new numbers: neither is written");
}

int main(void)
{
	for (size_t i = 0; i < sizeof(changes) / sizeof(changes[0]); i++)
		test_a_change(&changes[i]);
	test_again();
	test_two_maps();
	test_room();
	test_no_links();
	if (root[0])
		nftw(root, drop_one, 20, FTW_DEPTH | FTW_PHYS);
	return tap_done();
}
