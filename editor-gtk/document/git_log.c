/* SPDX-License-Identifier: MIT
 *
 * git_log - see git_log.h.
 */
#include "editor-gtk/document/git_log.h"

#include "editor-gtk/kit/i18n.h"

#include <string.h>

#define MOST "--max-count=500"
/* Fields of a revision end with US, a revision with NUL. "\nM", "\nR100" and the like follow, a
 * name, and behind R and C the newer name, each with a NUL. A merge may have none of them. */
#define FORMAT "--format=%H%x1f%h%x1f%aI%x1f%s"
#define FIELDS 4
#define BRIEF 8        /* letters of a revision in a message                  */

/* A call that waits for its program. */
struct call {
	GSubprocess *program;
	char *name;          /* of the file                                      */
	char *brief;         /* of the revision; NULL: all are read              */
	git_log_take *take_log;
	git_text_take *take_text;
	gpointer data;
};

static void call_free(struct call *call)
{
	g_clear_object(&call->program);
	g_free(call->name);
	g_free(call->brief);
	g_free(call);
}

static void fail(const struct call *call, const char *why)
{
	if (call->take_log)
		call->take_log(call->data, NULL, why);
	else
		call->take_text(call->data, NULL, 0, why);
}

/* ---- what git answered ---- */

static void revision_free(gpointer data)
{
	struct git_revision *revision = data;

	g_free(revision->hash);
	g_free(revision->brief);
	g_free(revision->date);
	g_free(revision->subject);
	g_free(revision->name);
	g_free(revision);
}

static char *date_text(const char *iso)
{
	GDateTime *date = g_date_time_new_from_iso8601(iso, NULL);
	GDateTime *local = date ? g_date_time_to_local(date) : NULL;
	char *text = local ? g_date_time_format(local, "%x %H:%M") : g_strdup(iso);

	g_clear_pointer(&date, g_date_time_unref);
	g_clear_pointer(&local, g_date_time_unref);
	return text;
}

static const char *behind(const char *text, const char *end)
{
	return text < end ? text + strlen(text) + 1 : end;
}

/* Reads the names behind a revision. @name: in: of the file in newer revisions; out: its name
 * before this one. Returns what follows. */
static const char *read_names(const char *at, const char *end, struct git_revision *revision,
			      const char **name)
{
	const bool has = at < end && *at == '\n';
	const bool renamed = has && (at[1] == 'R' || at[1] == 'C');
	const char *first = has ? behind(at, end) : NULL;
	const char *second = renamed ? behind(first, end) : first;

	if (has && second < end) {
		revision->name = g_strdup(second);
		*name = first;
		return behind(second, end);
	}
	revision->name = g_strdup(*name);
	return has ? end : at;
}

static struct git_revision *revision_new(const char *text)
{
	char **field = g_strsplit(text, "\x1f", FIELDS);
	struct git_revision *revision = NULL;

	if (g_strv_length(field) == FIELDS) {
		revision = g_new(struct git_revision, 1);
		*revision = (struct git_revision){ g_strdup(field[0]), g_strdup(field[1]),
			date_text(field[2]), g_utf8_make_valid(field[3], -1), NULL };
	}
	g_strfreev(field);
	return revision;
}

/* @name: of the file, if the first revision tells none. */
static GPtrArray *revisions_of(const char *bytes, gsize len, const char *name)
{
	GPtrArray *all = g_ptr_array_new_with_free_func(revision_free);
	const char *end = bytes + len, *at = bytes;

	while (at < end) {
		struct git_revision *revision = revision_new(at);

		at = behind(at, end);
		if (!revision)
			continue;
		at = read_names(at, end, revision, &name);
		g_ptr_array_add(all, revision);
	}
	return all;
}

static void take_log(const struct call *call, GBytes *out)
{
	const gsize len = out ? g_bytes_get_size(out) : 0;
	char *bytes = g_malloc0(len + 1), *why; /* its bytes have no NUL behind them */
	char *name = g_strdup_printf("./%s", call->name);
	GPtrArray *all;

	if (len)
		memcpy(bytes, g_bytes_get_data(out, NULL), len);
	all = revisions_of(bytes, len, name);
	g_free(name);
	g_free(bytes);
	if (all->len) {
		call->take_log(call->data, all, NULL);
		return;
	}
	g_ptr_array_unref(all);
	why = g_strdup_printf(_("No revision in git has “%s”."), call->name);
	fail(call, why);
	g_free(why);
}

static void take_text(const struct call *call, GBytes *out)
{
	const gsize len = out ? g_bytes_get_size(out) : 0;
	char *text = g_malloc(len + 1);

	if (len)
		memcpy(text, g_bytes_get_data(out, NULL), len);
	text[len] = '\0';
	call->take_text(call->data, text, len, NULL);
}

/* Hands over the message of git, or the reason why git did not run. */
static void refuse(const struct call *call, GBytes *said)
{
	char *text = said ? g_strndup(g_bytes_get_data(said, NULL), g_bytes_get_size(said)) :
			    g_strdup("");
	char *valid = g_utf8_make_valid(text, -1), *why;

	if (call->brief && (strstr(valid, "does not exist in") || strstr(valid, "but not in")))
		why = g_strdup_printf(_("“%s” is not in revision %s."), call->name, call->brief);
	else if (strstr(valid, "not a git repository"))
		why = g_strdup_printf(_("“%s” is not in a git repository."), call->name);
	else
		why = g_strdup_printf(_("git cannot read “%s”: %s"), call->name,
				      g_strstrip(valid));
	fail(call, why);
	g_free(why);
	g_free(valid);
	g_free(text);
}

static void ended(GObject *source, GAsyncResult *result, gpointer data)
{
	struct call *call = data;
	GBytes *out = NULL, *said = NULL;
	GError *error = NULL;

	if (!g_subprocess_communicate_finish(G_SUBPROCESS(source), result, &out, &said,
					     &error)) {
		if (!g_error_matches(error, G_IO_ERROR, G_IO_ERROR_CANCELLED))
			fail(call, error->message);
	} else if (!g_subprocess_get_successful(call->program)) {
		refuse(call, said);
	} else if (call->take_log) {
		take_log(call, out);
	} else {
		take_text(call, out);
	}
	g_clear_pointer(&out, g_bytes_unref);
	g_clear_pointer(&said, g_bytes_unref);
	g_clear_error(&error);
	call_free(call);
}

/* ---- starting it ---- */

/* It reads only what is here: no locks, no questions, no fetching. */
static GSubprocess *start(const char *folder, const char *const *words, GError **error)
{
	GSubprocessLauncher *launcher = g_subprocess_launcher_new(
		G_SUBPROCESS_FLAGS_STDOUT_PIPE | G_SUBPROCESS_FLAGS_STDERR_PIPE);
	GSubprocess *program;

	g_subprocess_launcher_set_cwd(launcher, folder);
	g_subprocess_launcher_setenv(launcher, "GIT_OPTIONAL_LOCKS", "0", TRUE);
	g_subprocess_launcher_setenv(launcher, "GIT_TERMINAL_PROMPT", "0", TRUE);
	g_subprocess_launcher_setenv(launcher, "GIT_NO_LAZY_FETCH", "1", TRUE);
	g_subprocess_launcher_setenv(launcher, "LC_ALL", "C", TRUE);
	program = g_subprocess_launcher_spawnv(launcher, words, error);
	g_object_unref(launcher);
	return program;
}

/* Takes @call. */
static void run(const char *path, const char *const *words, GCancellable *cancel,
		struct call *call)
{
	char *folder = g_path_get_dirname(path);
	GError *error = NULL;

	if (!call->name)
		call->name = g_path_get_basename(path);
	call->program = start(folder, words, &error);
	if (call->program) {
		g_subprocess_communicate_async(call->program, NULL, cancel, ended, call);
	} else {
		fail(call, g_error_matches(error, G_SPAWN_ERROR, G_SPAWN_ERROR_NOENT) ?
		     _("git is not installed.") : error->message);
		call_free(call);
	}
	g_clear_error(&error);
	g_free(folder);
}

void git_log_read(const char *path, GCancellable *cancel, git_log_take *take, gpointer data)
{
	struct call *call = g_new0(struct call, 1);
	char *file = g_path_get_basename(path);
	const char *const words[] = { "git", "--literal-pathspecs", "-c",
		"core.fsmonitor=false", "-c", "i18n.logOutputEncoding=UTF-8", "log",
		"--no-show-signature", "--no-color", "--follow", "--name-status",
		"--no-relative", MOST, "-z", FORMAT, "--", file, NULL };

	call->take_log = take;
	call->data = data;
	run(path, words, cancel, call);
	g_free(file);
}

void git_log_show(const char *path, const char *hash, const char *name, GCancellable *cancel,
		  git_text_take *take, gpointer data)
{
	struct call *call = g_new0(struct call, 1);
	char *object = g_strdup_printf("%s:%s", hash, name);
	const char *const words[] = { "git", "-c", "core.fsmonitor=false", "cat-file", "blob",
				      object, NULL };

	call->take_text = take;
	call->data = data;
	call->name = g_path_get_basename(name);
	call->brief = g_strndup(hash, BRIEF);
	run(path, words, cancel, call);
	g_free(object);
}
