/* SPDX-License-Identifier: MIT
 *
 * editor_start - measures the time until the first picture of the editor, each time in a
 * process of its own. Also has the statistics of tests/bench/editor.
 */
#include "tests/bench/editor_start.h"

#include "editor-gtk/window/app.h"

#include <stdio.h>
#include <stdlib.h>
#include <sys/resource.h>
#include <time.h>
#include <unistd.h>

#define STARTS 9
#define BEGUN "RUNGBOARD_BENCH_BEGUN" /* us, start of the process              */

/* Processor time of the whole process in us. */
gint64 process_worked(void)
{
	struct rusage used;

	getrusage(RUSAGE_SELF, &used);
	return (gint64)(used.ru_utime.tv_sec + used.ru_stime.tv_sec) * G_USEC_PER_SEC +
	       used.ru_utime.tv_usec + used.ru_stime.tv_usec;
}

static int compare(const void *a, const void *b)
{
	const gint64 left = *(const gint64 *)a, right = *(const gint64 *)b;

	return (left > right) - (left < right);
}

double median(gint64 *us, int count)
{
	qsort(us, (size_t)count, sizeof(*us), compare);
	return (double)us[count / 2] / 1000;
}

static bool drawn;

static gboolean render(GSignalInvocationHint *hint, guint count, const GValue *values,
		       gpointer unused)
{
	(void)hint;
	(void)count;
	(void)values;
	(void)unused;
	drawn = true;
	return TRUE;
}

static gboolean shown(GSignalInvocationHint *hint, guint count, const GValue *values,
		      gpointer unused)
{
	const gint64 begun = g_ascii_strtoll(g_getenv(BEGUN), NULL, 10);

	(void)hint;
	(void)count;
	(void)values;
	(void)unused;
	if (!drawn)
		return TRUE;
	printf("%" G_GINT64_FORMAT " %" G_GINT64_FORMAT "\n",
	       g_get_monotonic_time() - begun, process_worked());
	fflush(stdout);
	_exit(0);
}

/* The editor itself, until its first picture. */
int start(int argc, char **argv)
{
	g_type_class_ref(GDK_TYPE_FRAME_CLOCK);
	g_type_class_ref(GDK_TYPE_SURFACE);
	g_signal_add_emission_hook(g_signal_lookup("render", GDK_TYPE_SURFACE), 0, render,
				   NULL, NULL);
	g_signal_add_emission_hook(g_signal_lookup("after-paint", GDK_TYPE_FRAME_CLOCK), 0,
				   shown, NULL, NULL);
	return app_run(argc, argv);
}

void starts(const char *program, const char *sample)
{
	gint64 clock[STARTS], process[STARTS];

	for (int i = 0; i < STARTS; i++) {
		char *argv[] = { (char *)program, (char *)sample, NULL }, *out = NULL;
		char begun[32], *behind = NULL;

		g_snprintf(begun, sizeof(begun), "%" G_GINT64_FORMAT,
			   g_get_monotonic_time());
		g_setenv(BEGUN, begun, TRUE);
		if (!g_spawn_sync(NULL, argv, NULL, G_SPAWN_DEFAULT, NULL, NULL, &out, NULL,
				  NULL, NULL) || !out || !*out) {
			fprintf(stderr, "no start\n");
			exit(2);
		}
		clock[i] = g_ascii_strtoll(out, &behind, 10);
		process[i] = g_ascii_strtoll(behind, NULL, 10);
		g_free(out);
	}
	g_unsetenv(BEGUN);
	printf("Start with %s, to the first picture: %.0f ms by the clock, %.0f ms of the "
	       "processor, medians of %d (400).\n", sample, median(clock, STARTS),
	       median(process, STARTS), STARTS);
	fflush(stdout);
}

bool start_is_one(void)
{
	return g_getenv(BEGUN) != NULL;
}
