/* SPDX-License-Identifier: MIT
 *
 * scenario_run - runs the scenarios of a project.
 */
#include "editor-gtk/sim/scenario_run.h"

#include "editor-gtk/kit/diag_said.h"
#include "editor-gtk/document/disk.h"
#include "editor-gtk/document/side_file.h"
#include "editor-gtk/kit/i18n.h"
#include "editor-gtk/sim/sim_program.h"

#include "engine/base/limits.h"
#include "engine/trial/scenario.h"

#include <string.h>

#define FILE_MOST (4 << 20) /* bytes of a scenario file                          */

static void scenario_result_free(struct scenario_result *result)
{
	g_free(result->path);
	g_free(result->name);
	g_free(result->why);
	g_free(result->plant);
	g_clear_pointer(&result->acts, g_array_unref);
	g_free(result);
}

/* ---- which files ---- */

GPtrArray *scenario_files(const char *path)
{
	return side_file_list(path, ".scn", true);
}

/* ---- running ---- */

struct job {
	struct ladder *reader;  /* NULL: it was used                            */
	char *file, *program;
	gsize len;
	GPtrArray *files, *texts;
	bool stop;              /* set by the main thread                       */
};

struct running {
	struct job *job;
	struct sim_program *program;
	struct scenario_file *file;
	const char *path, *text; /* of the scenario file                        */
	gsize len;
	char *plant_path;
	struct sim_program *plant; /* that the file names; NULL: none          */
	GPtrArray *results;
};

static void job_free(gpointer data)
{
	struct job *job = data;

	ladder_free(job->reader);
	g_free(job->file);
	g_free(job->program);
	g_ptr_array_unref(job->files);
	g_ptr_array_unref(job->texts);
	g_free(job);
}

static struct scenario_result *add(GPtrArray *results, enum scenario_outcome outcome,
				   const char *path, const char *name, char *why)
{
	struct scenario_result *result = g_new0(struct scenario_result, 1);

	result->outcome = outcome;
	result->path = g_strdup(path);
	result->name = g_strdup(name);
	result->why = why;
	g_ptr_array_add(results, result);
	return result;
}

static void add_diags(GPtrArray *results, const char *path, const struct diag_list *diags)
{
	for (int i = 0; i < diags->count; i++) {
		const struct diag *diag = &diags->diag[i];
		struct scenario_result *result;

		if (diag_severity(diag->id) != SEVERITY_ERROR)
			continue;
		result = add(results, SCENARIO_UNREAD, path, "", diag_said_whole(diag));
		result->line = diag->line;
		result->column = diag->column;
	}
}

/* "at 50 ms: not true: expect Motor = 1". Caller frees. */
static char *why_of(const struct running *running, const struct scenario *scenario,
		    const struct resource *resource, const struct plant *plant)
{
	const struct scenario_step *step = scenario->failed_step;
	const union iec_value when = { .i = scenario->failed_ns };
	char time[40], *what, *why;

	iec_value_print(IEC_TIME, when, time, sizeof(time));
	if (step)
		what = g_strndup(step->text, (gsize)step->text_len);
	else if (scenario->failure == FAILURE_PLANT)
		what = sim_fault_words(running->plant, &plant->resource);
	else
		what = sim_fault_words(running->program, resource);
	why = g_strdup_printf(_("at %s ms: %s: %s"), time,
			      said(scenario_failure_text(scenario->failure)), what);
	g_free(what);
	return why;
}

static void keep_act(void *context, uint64_t after, const struct act *act)
{
	struct sim_played played = { .after = after, .act = *act };

	if (act->kind == ACT_SET && act->at.type == IEC_STRING) {
		struct iec_string *text = iec_text_init(&played.text,
							act->value.s->length);

		memcpy(text->text, act->value.s->text, act->value.s->length);
		played.act.value.s = NULL;
	}
	g_array_append_val((GArray *)context, played);
}

static struct formula_projects projects_of(const struct running *running)
{
	return (struct formula_projects){ ladder_project(running->program->ladder),
		running->plant ? ladder_project(running->plant->ladder) : NULL };
}

/* Keeps the acts up to the failure, to repeat them in the simulation. */
static void keep_way(struct running *running, int index, struct scenario_result *result)
{
	const bool plant = running->file->scenario[index].with_plant && running->plant;
	struct diag_list *diags = g_new0(struct diag_list, 1);
	struct twin *twin = g_new0(struct twin, 1);
	struct scenario_file file;
	struct arena arena;

	diag_init(diags);
	arena_init(&arena);
	result->plant = plant ? g_strdup(running->plant_path) : NULL;
	result->acts = g_array_new(FALSE, FALSE, sizeof(struct sim_played));
	if (twin_init(twin, running->program->program,
		      plant ? running->plant->program : NULL, result->period_ns) &&
	    scenario_read(running->file->file, running->text, running->len,
			  &twin->resource.image, plant ? &twin->plant.image : NULL,
			  projects_of(running), &arena, &file, diags))
		scenario_each_act(&file, index, twin, result->scan, keep_act,
				  result->acts);
	twin_free(twin);
	arena_free(&arena);
	g_free(twin);
	g_free(diags);
}

/* The report is written for a terminal; the results list has the first failure. */
static void drop_report(void *context, const char *text, size_t len)
{
	(void)context;
	(void)text;
	(void)len;
}

static void run_one(struct running *running, int index, struct resource *resource,
		    struct plant *plant)
{
	const struct scenario *scenario = &running->file->scenario[index];
	struct scenario_result *result;
	const struct sink out = { .write = drop_report };
	const bool held = scenario_run(running->file, index, resource, plant, &out);

	result = add(running->results, held ? SCENARIO_HELD : SCENARIO_FAILED,
		     running->path, scenario->name,
		     scenario->failed_line ? why_of(running, scenario, resource, plant) :
		     g_strdup(""));
	result->first_line = scenario->line;
	result->line = scenario->failed_line;
	result->scan = scenario->failed_scan;
	result->period_ns = scenario->period_ns;
	result->speed = scenario->speed;
	if (!held && !running->job->stop)
		keep_way(running, index, result);
}

/* Reads the plant that the file names. False: it cannot be read, which is added as a result. */
static bool find_plant(struct running *running)
{
	struct scenario_result *result;
	struct arena arena;
	struct diag place;
	const char *name;
	char *folder = g_path_get_dirname(running->path), *text = NULL;
	GError *error = NULL;
	gsize len;

	arena_init(&arena);
	name = scenario_find_plant(running->path, running->text, running->len, &arena,
				   &place);
	if (name) {
		running->plant_path = g_canonicalize_filename(name, folder);
		text = disk_read(running->plant_path, LIMIT_TEXT, &len, &error);
	}
	if (text)
		running->plant = sim_program_new(g_intern_string(running->plant_path),
						 text, len, &error);
	if (error) {
		result = add(running->results, SCENARIO_UNREAD, running->path, "",
			     g_strdup_printf(_("%s: %s"), name, error->message));
		result->line = place.line;
	}
	g_free(folder);
	g_free(text);
	arena_free(&arena);
	return !error || (g_error_free(error), false);
}

static void run_all_of(struct running *running, struct resource *resource,
		       struct plant *plant)
{
	struct diag_list *diags = g_new0(struct diag_list, 1);
	char *name = g_path_get_basename(running->path);
	struct scenario_file file;
	struct arena arena;

	diag_init(diags);
	arena_init(&arena);
	running->file = &file;
	if (scenario_read(name, running->text, running->len, &resource->image,
			  plant ? &plant->resource.image : NULL,
			  projects_of(running), &arena, &file, diags)) {
		file.stop = &running->job->stop;
		for (int i = 0; i < file.count && !running->job->stop; i++)
			run_one(running, i, resource, plant);
	} else {
		add_diags(running->results, running->path, diags);
	}
	arena_free(&arena);
	g_free(name);
	g_free(diags);
}

static void run_text(struct running *running, const char *text, gsize len)
{
	const struct program *program = running->program->program;
	struct resource *resource = g_new0(struct resource, 1);
	struct plant *plant = NULL;
	gpointer memory = g_malloc0(image_memory_size(program));

	running->text = text;
	running->len = len;
	resource_init(resource, program, memory);
	if (find_plant(running)) {
		if (running->plant) {
			plant = g_new0(struct plant, 1);
			if (!plant_init(plant, running->plant->program, program))
				g_error("out of memory");
		}
		run_all_of(running, resource, plant);
	}
	if (plant)
		plant_free(plant);
	g_free(plant);
	g_clear_pointer(&running->plant, sim_program_unref);
	g_clear_pointer(&running->plant_path, g_free);
	g_free(memory);
	g_free(resource);
}

static void run_file(struct running *running, guint index)
{
	const char *given = running->job->texts->pdata[index];
	GError *error = NULL;
	gsize len;
	char *text;

	running->path = running->job->files->pdata[index];
	if (given) {
		run_text(running, given, strlen(given));
		return;
	}
	text = disk_read(running->path, FILE_MOST, &len, &error);
	if (text)
		run_text(running, text, len);
	else
		add(running->results, SCENARIO_UNREAD, running->path, "",
		    g_strdup(error->message));
	g_clear_error(&error);
	g_free(text);
}

static void cancelled(GCancellable *stop, struct job *job)
{
	(void)stop;
	job->stop = true;
}

static void run(GTask *task, gpointer source, gpointer data, GCancellable *stop)
{
	struct job *job = data;
	struct running running = { .job = job };
	gulong stopped = 0;
	GError *error = NULL;

	(void)source;
	if (stop)
		stopped = g_cancellable_connect(stop, G_CALLBACK(cancelled), job, NULL);
	running.results = g_ptr_array_new_with_free_func(
		(GDestroyNotify)scenario_result_free);
	running.program = sim_program_read(g_steal_pointer(&job->reader), job->file, job->program,
					   job->len, &error);
	if (!running.program)
		add(running.results, SCENARIO_UNREAD, job->file, "",
		    g_strdup_printf(_("The program has errors: %s"), error->message));
	for (guint i = 0; running.program && i < job->files->len && !job->stop; i++)
		run_file(&running, i);
	if (stop)
		g_cancellable_disconnect(stop, stopped);
	g_clear_error(&error);
	sim_program_unref(running.program);
	g_task_return_pointer(task, running.results, (GDestroyNotify)g_ptr_array_unref);
}

void scenario_run_all(struct ladder *reader, const char *file, const char *program, gsize len,
		      GPtrArray *files, GPtrArray *texts, GCancellable *stop, GAsyncReadyCallback done,
		      gpointer data)
{
	struct job *job = g_new0(struct job, 1);
	GTask *task = g_task_new(NULL, stop, done, data);

	job->reader = reader;
	job->file = g_strdup(file);
	job->program = g_strndup(program, len);
	job->len = len;
	job->files = files;
	job->texts = texts;
	g_task_set_task_data(task, job, job_free);
	g_task_run_in_thread(task, run);
	g_object_unref(task);
}

GPtrArray *scenario_run_finish(GAsyncResult *result)
{
	return g_task_propagate_pointer(G_TASK(result), NULL);
}
