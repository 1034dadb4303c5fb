/* SPDX-License-Identifier: MIT
 *
 * draft - keeps unsaved text where a crash does not reach it.
 *
 * A draft is a file "PID-RANDOM-NUMBER.draft". Its first line has the path as a URI, the
 * digest of that file and, for a file beside a project, the URI of the project, as far as
 * they are known. The text follows. A draft whose process is alive belongs to that process.
 *
 * A thread writes the drafts, because a disk may take longer than a frame. Only the latest text
 * of a draft is written.
 */
#include "editor-gtk/document/draft.h"

#include <glib/gstdio.h>
#include <errno.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#define PAUSE_MS  250  /* after the last change …                              */
#define LATEST_MS 1000 /* … and behind the first one that no draft has         */
#define SHARE     25   /* making the text takes at most this part of the time  */
#define DRAFT_HEAD    "RUNGBOARD-DRAFT 1 "

#define DRAFT_BESIDE  "beside:"
#define DRAFT_SAMPLE  "sample:"

/* The file of a draft, for the keeper and the texts that wait to be written. */
struct slot {
	gatomicrefcount count;
	GMutex lock;            /* held while the file is written or deleted   */
	char *file;
	guint wanted;           /* number of the text that the file should have */
};

struct job {
	struct slot *slot;
	guint number;
	char *whole;
	GWeakRef object;
	char *why;              /* it could not be written                     */
};

struct keeper {
	struct slot *slot;
	guint timer;
	gint64 since;           /* of the first change that no draft has; 0: none */
	guint cost_ms;          /* of making the text                          */
	LadderDocument *beside; /* of a file beside it; NULL: of a document    */
	char *sample;           /* the sample that the document is a copy of; NULL: none */
	bool told;              /* the failure was reported                    */
};

static void (*failed)(gpointer object, const char *why);

static char *folder(void)
{
	return g_build_filename(g_get_user_state_dir(), "rungboard", "drafts", NULL);
}

/* How the names of own drafts begin. After a restart, and in containers at every start, an
 * editor may have the process number of a dead one, whose drafts are not its own. */
static const char *own_begin(void)
{
	static char begin[32];

	if (!*begin)
		g_snprintf(begin, sizeof(begin), "%ld-%08x-", (long)getpid(), g_random_int());
	return begin;
}

static struct keeper *keeper_of(gpointer object)
{
	return g_object_get_data(G_OBJECT(object), "draft");
}

/* ---- keeping ---- */

static bool is_saved(gpointer object)
{
	return keeper_of(object)->beside ? !ladder_side_file_differs(object) :
		ladder_document_is_saved(object);
}

static char *uri_of(const char *path)
{
	char *uri = path ? g_filename_to_uri(path, NULL, NULL) : NULL;

	return uri ? uri : g_strdup("");
}

static char *document_draft(LadderDocument *document)
{
	const char *sample = keeper_of(document)->sample;
	const char *sum = ladder_document_disk_sum(document);
	char *uri = uri_of(ladder_document_path(document));
	char *text = ladder_document_text(document, NULL);
	char *from = uri_of(sample);
	char *whole = g_strdup_printf(DRAFT_HEAD "%s %s%s%s\n%s", uri, sum ? sum : "",
				      sample ? " " DRAFT_SAMPLE : "", from, text);

	g_free(from);
	g_free(text);
	g_free(uri);
	return whole;
}

static char *file_draft(LadderSideFile *file, LadderDocument *beside)
{
	char *uri = uri_of(ladder_side_file_path(file));
	char *project = uri_of(ladder_document_path(beside));
	char *sum = ladder_side_file_sum(file), *text = ladder_side_file_text(file);
	char *whole = g_strdup_printf(DRAFT_HEAD "%s %s " DRAFT_BESIDE "%s\n%s", uri, sum,
				      project, text);

	g_free(text);
	g_free(sum);
	g_free(project);
	g_free(uri);
	return whole;
}

/* Reports a failure once, until a draft can be written again. */
static void tell_failed(gpointer object, struct keeper *keeper, const char *why)
{
	if (failed && !keeper->told)
		failed(object, why);
	keeper->told = true;
}

/* ---- writing ---- */

static struct slot *slot_new(char *file)
{
	struct slot *slot = g_new0(struct slot, 1);

	g_atomic_ref_count_init(&slot->count);
	g_mutex_init(&slot->lock);
	slot->file = file;
	return slot;
}

static void slot_unref(struct slot *slot)
{
	if (!g_atomic_ref_count_dec(&slot->count))
		return;
	g_mutex_clear(&slot->lock);
	g_free(slot->file);
	g_free(slot);
}

/* The number of a further text; those before it are not written any more. */
static guint slot_next(struct slot *slot)
{
	guint number;

	g_mutex_lock(&slot->lock);
	number = ++slot->wanted;
	g_mutex_unlock(&slot->lock);
	return number;
}

static void slot_delete(struct slot *slot)
{
	g_mutex_lock(&slot->lock);
	slot->wanted++;
	g_unlink(slot->file);
	g_mutex_unlock(&slot->lock);
}

static void job_write(struct job *job)
{
	struct slot *slot = job->slot;
	char *dir = g_path_get_dirname(slot->file);
	GError *error = NULL;

	g_mutex_lock(&slot->lock);
	g_mkdir_with_parents(dir, 0700);
	if (job->number == slot->wanted &&
	    !g_file_set_contents_full(slot->file, job->whole, (gssize)strlen(job->whole),
		    G_FILE_SET_CONTENTS_CONSISTENT | G_FILE_SET_CONTENTS_DURABLE, 0600, &error))
		job->why = g_strdup(error->message);
	g_mutex_unlock(&slot->lock);
	g_clear_error(&error);
	g_free(dir);
}

static void job_free(struct job *job)
{
	g_weak_ref_clear(&job->object);
	slot_unref(job->slot);
	g_free(job->whole);
	g_free(job->why);
	g_free(job);
}

static void job_tell(struct job *job, gpointer object)
{
	struct keeper *keeper = keeper_of(object);

	if (keeper && job->why)
		tell_failed(object, keeper, job->why);
	else if (keeper)
		keeper->told = false;
}

static gboolean job_ended(gpointer pointer)
{
	struct job *job = pointer;
	gpointer object = g_weak_ref_get(&job->object);

	if (object) {
		job_tell(job, object);
		g_object_unref(object);
	}
	job_free(job);
	return G_SOURCE_REMOVE;
}

static void job_run(gpointer job, G_GNUC_UNUSED gpointer data)
{
	job_write(job);
	g_idle_add(job_ended, job);
}

static struct job *job_new(gpointer object)
{
	struct keeper *keeper = keeper_of(object);
	struct job *job = g_new0(struct job, 1);
	const gint64 begin = g_get_monotonic_time();

	job->whole = keeper->beside ? file_draft(object, keeper->beside) : document_draft(object);
	job->slot = keeper->slot;
	g_atomic_ref_count_inc(&job->slot->count);
	job->number = slot_next(job->slot);
	g_weak_ref_init(&job->object, object);
	keeper->cost_ms = (guint)((g_get_monotonic_time() - begin) / 1000);
	keeper->since = 0;
	return job;
}

void draft_write(gpointer object)
{
	struct job *job;

	if (!keeper_of(object) || is_saved(object))
		return;
	job = job_new(object);
	job_write(job);
	job_tell(job, object);
	job_free(job);
}

static gboolean write_soon(gpointer object)
{
	static GThreadPool *pool;

	keeper_of(object)->timer = 0;
	if (is_saved(object))
		return G_SOURCE_REMOVE;
	if (!pool)
		pool = g_thread_pool_new(job_run, NULL, 1, FALSE, NULL);
	g_thread_pool_push(pool, job_new(object), NULL);
	return G_SOURCE_REMOVE;
}

/* Milliseconds until the draft is written. */
static guint delay_of(struct keeper *keeper)
{
	const guint least = SHARE * keeper->cost_ms;
	const guint pause = MAX(PAUSE_MS, least), latest = MAX(LATEST_MS, least);
	const gint64 now = g_get_monotonic_time();
	gint64 left;

	if (!keeper->since)
		keeper->since = now;
	left = latest - (now - keeper->since) / 1000;
	return (guint)CLAMP(left, 0, (gint64)pause);
}

static void state_changed(gpointer object, struct keeper *keeper)
{
	g_clear_handle_id(&keeper->timer, g_source_remove);
	if (is_saved(object)) {
		keeper->since = 0;
		slot_delete(keeper->slot);
		return;
	}
	keeper->timer = g_timeout_add(delay_of(keeper), write_soon, object);
}

static void keeper_free(gpointer pointer)
{
	struct keeper *keeper = pointer;

	if (keeper->timer)
		g_source_remove(keeper->timer);
	g_clear_object(&keeper->beside);
	g_free(keeper->sample);
	slot_unref(keeper->slot);
	g_free(keeper);
}

static void keep(gpointer object, LadderDocument *beside)
{
	static int number;
	struct keeper *keeper = g_new0(struct keeper, 1);
	char *dir = folder();
	char *name = g_strdup_printf("%s%d.draft", own_begin(), ++number);

	keeper->beside = beside ? g_object_ref(beside) : NULL;
	keeper->slot = slot_new(g_build_filename(dir, name, NULL));
	g_object_set_data_full(G_OBJECT(object), "draft", keeper, keeper_free);
	g_signal_connect(object, "state-changed", G_CALLBACK(state_changed), keeper);
	draft_write(object);
	g_free(name);
	g_free(dir);
}

void draft_keep(LadderDocument *document)
{
	keep(document, NULL);
}

void draft_of_sample(LadderDocument *document, const char *path)
{
	struct keeper *keeper = keeper_of(document);

	if (!keeper)
		return;
	g_free(keeper->sample);
	keeper->sample = g_strdup(path);
	draft_write(document);
}

static void text_changed(LadderSideFile *file)
{
	state_changed(file, keeper_of(file));
}

void draft_keep_file(LadderSideFile *file, LadderDocument *document)
{
	keep(file, document);
	g_signal_connect_object(ladder_side_file_buffer(file), "changed",
				G_CALLBACK(text_changed), file, G_CONNECT_SWAPPED);
}

void draft_remove(gpointer object)
{
	struct keeper *keeper = keeper_of(object);

	if (!keeper)
		return;
	g_clear_handle_id(&keeper->timer, g_source_remove);
	keeper->since = 0;
	slot_delete(keeper->slot);
}

bool draft_is_kept(gpointer object)
{
	return keeper_of(object) && !keeper_of(object)->told;
}

void draft_stop(gpointer object)
{
	struct keeper *keeper = keeper_of(object);

	if (!keeper)
		return;
	g_signal_handlers_disconnect_by_data(object, keeper);
	g_object_set_data(G_OBJECT(object), "draft", NULL);
}

void draft_on_failure(void (*tell)(gpointer object, const char *why))
{
	failed = tell;
}

/* ---- finding ---- */

static void draft_free(gpointer pointer)
{
	struct draft *draft = pointer;

	g_free(draft->file);
	g_free(draft->path);
	g_free(draft->sum);
	g_free(draft->beside);
	g_free(draft->sample);
	g_free(draft->text);
	g_free(draft);
}

/* Name and state of a process, "(ladder-editor) S"; NULL: no /proc. Caller frees. */
static char *process_text(long pid)
{
	char *path = g_strdup_printf("/proc/%ld/stat", pid), *stat = NULL, *text = NULL;

	if (g_file_get_contents(path, &stat, NULL, NULL) && strchr(stat, '('))
		text = g_strndup(strchr(stat, '('),
				 (gsize)(strrchr(stat, ')') + 3 - strchr(stat, '(')));
	g_free(stat);
	g_free(path);
	return text;
}

/* Process numbers are used again: only an editor counts as the owner of a draft. A killed one
 * keeps its number until its parent has waited for it: then it is a zombie. Without /proc any
 * process counts. */
static bool is_alive(const char *name)
{
	const long pid = strtol(name, NULL, 10);
	bool alive = pid > 0 && (kill((pid_t)pid, 0) == 0 || errno == EPERM);
	char *own = process_text(getpid()), *text = process_text(pid);
	const gsize len = own ? strlen(own) - 1 : 0;

	if (alive && own && text)
		alive = strlen(text) == len + 1 && strncmp(own, text, len) == 0 &&
			!strchr("ZX", text[len]);
	g_free(text);
	g_free(own);
	return alive && (pid != getpid() || g_str_has_prefix(name, own_begin()));
}

static char *path_of(const char *uri)
{
	return *uri ? g_filename_from_uri(uri, NULL, NULL) : NULL;
}

/* "URI SUM beside:URI", "URI SUM sample:URI": each part may be missing. A URI has no
 * blanks. */
static void read_head(struct draft *draft, const char *head)
{
	char **words = g_strsplit(head, " ", 3);
	const int count = (int)g_strv_length(words);

	draft->path = count > 0 ? path_of(words[0]) : NULL;
	draft->sum = count > 1 && *words[1] ? g_strdup(words[1]) : NULL;
	draft->is_file = draft->path && count > 2 &&
			 g_str_has_prefix(words[2], DRAFT_BESIDE);
	if (draft->is_file)
		draft->beside = path_of(words[2] + strlen(DRAFT_BESIDE));
	else if (count > 2 && g_str_has_prefix(words[2], DRAFT_SAMPLE))
		draft->sample = path_of(words[2] + strlen(DRAFT_SAMPLE));
	g_strfreev(words);
}

/* Without a valid first line, everything is text, so that nothing is lost. */
static struct draft *read_draft(const char *file)
{
	struct draft *draft;
	char *all = NULL, *text, *line;
	gsize len;

	if (!g_file_get_contents(file, &all, &len, NULL) || len == 0) {
		g_free(all);
		return NULL;
	}
	draft = g_new0(struct draft, 1);
	draft->file = g_strdup(file);
	text = all;
	line = strchr(all, '\n');
	if (line && g_str_has_prefix(all, DRAFT_HEAD)) {
		*line = '\0';
		read_head(draft, all + strlen(DRAFT_HEAD));
		text = line + 1;
	}
	draft->text = g_utf8_make_valid(text, (gssize)(len - (gsize)(text - all)));
	draft->len = strlen(draft->text);
	g_free(all);
	return draft;
}

static int documents_first(gconstpointer a, gconstpointer b)
{
	const struct draft *const *one = a, *const *other = b;

	return (int)(*one)->is_file - (int)(*other)->is_file;
}

GPtrArray *draft_find(void)
{
	GPtrArray *found = g_ptr_array_new_with_free_func(draft_free);
	char *dir = folder();
	GDir *names = g_dir_open(dir, 0, NULL);
	const char *name;

	while (names && (name = g_dir_read_name(names))) {
		char *file = g_build_filename(dir, name, NULL);
		struct draft *draft = g_str_has_suffix(name, ".draft") && !is_alive(name) ?
			read_draft(file) : NULL;

		if (draft)
			g_ptr_array_add(found, draft);
		else if (strstr(name, ".draft.") && !is_alive(name))
			g_unlink(file); /* a draft that was not written to its end */
		g_free(file);
	}
	if (names)
		g_dir_close(names);
	g_free(dir);
	g_ptr_array_sort(found, documents_first);
	return found;
}

void draft_forget(const struct draft *draft)
{
	g_unlink(draft->file);
}
