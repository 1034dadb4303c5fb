/* SPDX-License-Identifier: MIT
 *
 * test_draft - drafts of a killed editor are found, those of a running one are not; an edit is in
 * the draft soon, also while others follow. No display.
 */
#include "editor-gtk/document/draft.h"

#include "tests/tap.h"

#include <glib/gstdio.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

static char *folder;

static void write_draft(pid_t pid)
{
	char *name = g_strdup_printf("%ld-0000abcd-1.draft", (long)pid);
	char *path = g_build_filename(folder, name, NULL);

	CHECK(g_file_set_contents(path, "RUNGBOARD 1\n", -1, NULL));
	g_free(path);
	g_free(name);
}

static guint count_found(void)
{
	GPtrArray *found = draft_find();
	const guint count = found->len;

	g_ptr_array_unref(found);
	return count;
}

static void forget_all(void)
{
	GPtrArray *found = draft_find();

	for (guint i = 0; i < found->len; i++)
		draft_forget(found->pdata[i]);
	g_ptr_array_unref(found);
}

/* A killed process is a zombie until its parent has waited for it. */
static void test_killed(void)
{
	const pid_t pid = fork();
	siginfo_t info;

	if (pid == 0) {
		pause();
		_exit(0);
	}
	write_draft(pid);
	CHECK_AS(count_found() == 0, "the draft of a running editor is left alone");
	kill(pid, SIGKILL);
	CHECK(waitid(P_PID, (id_t)pid, &info, WEXITED | WNOWAIT) == 0);
	CHECK_AS(count_found() == 1, "the draft of a killed editor is found at once");
	waitpid(pid, NULL, 0);
	CHECK_AS(count_found() == 1, "the draft of an ended editor is found");
	forget_all();
	CHECK(count_found() == 0);
}

/* ---- how soon ---- */

/* The only file of the folder; NULL: there is none. Caller frees. */
static char *draft_text(void)
{
	GDir *dir = g_dir_open(folder, 0, NULL);
	const char *name;
	char *text = NULL;

	while (!text && (name = g_dir_read_name(dir))) {
		char *path = g_build_filename(folder, name, NULL);

		if (g_str_has_suffix(name, ".draft"))
			g_file_get_contents(path, &text, NULL, NULL);
		g_free(path);
	}
	g_dir_close(dir);
	return text;
}

static void edit(LadderDocument *document, int number)
{
	char *text = g_strdup_printf("PROJECT \"Edit %d\"\n", number);
	char *whole = ladder_document_text(document, NULL);
	const gsize len = strcspn(whole + 12, "\n") + 1; /* its line PROJECT */

	CHECK(ladder_document_replace(document, 12, len, text, NULL));
	g_free(whole);
	g_free(text);
}

static bool has_edit(int number)
{
	char *wanted = g_strdup_printf("\"Edit %d\"", number), *text = draft_text();
	const bool has = text && strstr(text, wanted);

	g_free(text);
	g_free(wanted);
	return has;
}

static void run(unsigned int ms)
{
	const gint64 end = g_get_monotonic_time() + ms * 1000;

	while (g_get_monotonic_time() < end) {
		g_main_context_iteration(NULL, FALSE);
		g_usleep(1000);
	}
}

/* Somebody types without a pause. The edit in the first draft says when it was made. */
static void test_soon(LadderDocument *document)
{
	char *text = NULL, *at;
	int number = 0;

	while (!text && number < 100) {
		edit(document, ++number);
		run(50);
		text = draft_text();
	}
	CHECK_AS(text, "a draft is written while edits follow each other");
	at = text ? strstr(text, "\"Edit ") : NULL;
	CHECK_AS(at && atoi(at + 6) > 2 && atoi(at + 6) <= 22, "it is made within about a second");
	g_free(text);
	for (int i = 0; i < 100 && !has_edit(number); i++)
		run(50);
	CHECK_AS(has_edit(number), "after a pause the last edit is in it");
}

/* What waits to be written does not come back. */
static void test_removed(LadderDocument *document)
{
	for (int i = 0; i < 8; i++) {
		char *text;

		edit(document, 2000 + i);
		run(246 + (unsigned int)i);
		draft_remove(document);
		run(20);
		text = draft_text();
		CHECK(!text);
		g_free(text);
	}
}

static void test_kept(void)
{
	static const char text[] = "RUNGBOARD 1\nPROJECT \"A\"\n\nPROGRAM Main LD\nRUNG\n  | NO I0 | COIL Q0 |\n"
				   "END_PROGRAM\n";
	LadderDocument *document = ladder_document_new();

	ladder_document_open_text(document, NULL, text, strlen(text), true);
	draft_keep(document);
	test_soon(document);
	test_removed(document);
	edit(document, 5000);
	draft_write(document);
	CHECK_AS(has_edit(5000), "written at once");
	draft_remove(document);
	draft_stop(document);
	g_object_unref(document);
}

int main(void)
{
	char *state = g_dir_make_tmp("rungboard-XXXXXX", NULL);
	char *parent = g_build_filename(state, "rungboard", NULL);

	g_setenv("XDG_STATE_HOME", state, TRUE);
	folder = g_build_filename(parent, "drafts", NULL);
	CHECK(g_mkdir_with_parents(folder, 0700) == 0);
	test_killed();
	test_kept();
	g_rmdir(folder);
	g_rmdir(parent);
	g_rmdir(state);
	g_free(folder);
	g_free(parent);
	g_free(state);
	return tap_done();
}
