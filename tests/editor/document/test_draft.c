/* SPDX-License-Identifier: MIT
 *
 * test_draft - drafts of a killed editor are found, those of a running one are not. No display.
 */
#include "editor-gtk/document/draft.h"

#include "tests/tap.h"

#include <glib/gstdio.h>
#include <signal.h>
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

int main(void)
{
	char *state = g_dir_make_tmp("rungboard-XXXXXX", NULL);
	char *parent = g_build_filename(state, "rungboard", NULL);

	g_setenv("XDG_STATE_HOME", state, TRUE);
	folder = g_build_filename(parent, "drafts", NULL);
	CHECK(g_mkdir_with_parents(folder, 0700) == 0);
	test_killed();
	g_rmdir(folder);
	g_rmdir(parent);
	g_rmdir(state);
	g_free(folder);
	g_free(parent);
	g_free(state);
	return tap_done();
}
