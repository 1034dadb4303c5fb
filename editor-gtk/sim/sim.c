/* SPDX-License-Identifier: MIT
 *
 * sim - the window's side of a simulation: it orders the thread and reads copies of its state.
 *
 * It shows the newest copy, or a replay of the record for a scan of the past. The thread lives
 * from ladder_sim_begin() to ladder_sim_end().
 */
#include "editor-gtk/sim/sim_mirror.h"
#include "editor-gtk/sim/sim_shadow.h"
#include "editor-gtk/sim/stops_follow.h"
#include "editor-gtk/sim/sim_thread.h"

#include "editor-gtk/document/disk.h"
#include "editor-gtk/kit/i18n.h"

#include "engine/base/limits.h"
#include "engine/base/name.h"
#include "engine/compare/compare.h"
#include "engine/trial/pace.h"

#include <string.h>

struct _LadderSim {
	GObject parent;
	LadderDocument *document;
	GPtrArray *rungs;           /* by POU: GArray of int, by rung of the document:
				       its number in the program that runs; -1 */
	GByteArray *differs;        /* bool of each part and POU: the board has it otherwise */
	struct sim_source *source;  /* of what is shown; NULL: off             */
	struct sim_thread *thread;  /* the source, if that is the thread; else NULL */
	struct sim_mirror *mirror;  /* likewise                                */
	gint64 late_ns;             /* of the mirror                           */
	struct sim_view view;       /* the newest state                        */
	struct sim_replay *replay;  /* of the past; NULL: none yet             */
	bool past;                  /* `replay` is shown                       */
	LadderDocument *older;      /* of a program before an edit; NULL: none yet */
	guint64 older_era;          /* era of that program                     */
	guint64 life;               /* how often it began                      */
	guint refused;              /* count of the last refusal that was shown */
	struct sim_events known;    /* events that were shown                  */
	enum sim_state told;        /* state and period (ns) when state-changed */
	gint64 told_period;         /* was emitted last                        */
	gint64 period_ns;
	double speed;
	guint64 board_speed; /* words a millisecond; 0: scans take no time       */
	bool fault_on_error;
	char *plant_path;
	struct sim_program *plant;
	struct sim_program *newest; /* the last one given to the thread        */
	guint64 version;            /* of the document, when that was built     */
	struct rebuild *building;   /* NULL: nothing is built                   */
	struct rebuild *ahead;      /* built for a text that the document may get; NULL: none */
	int rest;                   /* texts that are not foreseen, as the last one did not come */
	guint soon;                 /* source that builds an edit; 0: none      */
	LadderBreakpoints *points;
	struct stops_follow *follow; /* moves them with their lines            */
};

enum { STATE_CHANGED, PROGRAM_GONE, PROGRAM_CHANGED, SHOWN, TOLD, REFUSED, SIGNAL_COUNT };
static guint signals[SIGNAL_COUNT];

G_DEFINE_FINAL_TYPE(LadderSim, ladder_sim, G_TYPE_OBJECT)

/* ---- which rung of the document is which of the program that runs ---- */

/* An edited rung is unknown until a program with it runs. Rungs above and below it keep their
 * numbers, and so their power. */
static void rungs_changed(LadderSim *sim, int pou, int at, int removed, int inserted)
{
	const int unknown = -1;
	GArray *of;

	if (pou < 0 || (guint)pou >= sim->rungs->len)
		return;
	of = sim->rungs->pdata[pou];
	if (at < 0 || (guint)(at + removed) > of->len)
		return;
	if (removed)
		g_array_remove_range(of, (guint)at, (guint)removed);
	for (int i = 0; i < inserted; i++)
		g_array_insert_val(of, (guint)(at + i), unknown);
}

static void forget_rungs(LadderSim *sim)
{
	g_ptr_array_set_size(sim->rungs, 0);
	g_byte_array_set_size(sim->differs, 0);
}

static GArray *rungs_of(LadderSim *sim, int pou)
{
	return pou >= 0 && (guint)pou < sim->rungs->len ? sim->rungs->pdata[pou] : NULL;
}

static void take_pair(void *context, struct compare_pair pair)
{
	GArray *of = rungs_of(context, pair.pou_a);

	if (of && pair.rung_a >= 0 && (guint)pair.rung_a < of->len && pair.rung_b >= 0 &&
	    !pair.changed)
		g_array_index(of, int, pair.rung_a) = pair.rung_b;
}

#define PARTS 3 /* of enum sim_part, in `differs` before the POUs                 */

static void mark_other(LadderSim *sim, int part)
{
	if (part + PARTS >= 0 && (guint)(part + PARTS) < sim->differs->len)
		sim->differs->data[part + PARTS] = true;
}

/* Text outside of the parts, such as the views, does not change what runs. */
static void take_difference(void *context, const struct compare_difference *what)
{
	LadderSim *sim = context;
	int pou;

	switch (what->group) {
	case COMPARE_PROJECT: break;
	case COMPARE_CONFIG: mark_other(sim, SIM_TASKS); break;
	case COMPARE_TYPES: mark_other(sim, SIM_TYPES); break;
	case COMPARE_GLOBALS: mark_other(sim, SIM_SYMBOLS); break;
	case COMPARE_POU:
		pou = what->pou ? project_find_pou(ladder_document_project(sim->document),
						   what->pou, strlen(what->pou)) : -1;
		if (pou >= 0)
			mark_other(sim, pou);
		break;
	}
}

/* The rungs of a chart are not paired one by one: those of an equal chart are the same. */
static void number_charts(LadderSim *sim, const struct project *project)
{
	for (int i = 0; i < project->pou_count; i++) {
		GArray *of = rungs_of(sim, i);

		for (int rung = 0; project->pou[i].sfc && !sim->differs->data[i + PARTS] &&
		     rung < (int)of->len; rung++)
			g_array_index(of, int, rung) = rung;
	}
}

/* The program that runs is the document as it is now; that of a board may be another. */
static void number_rungs(LadderSim *sim)
{
	const struct project *project = ladder_document_project(sim->document);
	const struct project *board = sim->mirror && sim->view.program ?
		ladder_project(sim->view.program->ladder) : NULL;

	forget_rungs(sim);
	for (int i = 0; project && i < project->pou_count; i++) {
		GArray *of = g_array_new(FALSE, FALSE, sizeof(int));

		for (int rung = 0; rung < project->pou[i].rung_count; rung++) {
			const int number = sim->mirror ? -1 : rung;

			g_array_append_val(of, number);
		}
		g_ptr_array_add(sim->rungs, of);
	}
	if (!project || !board)
		return;
	g_byte_array_set_size(sim->differs, (guint)project->pou_count + PARTS);
	memset(sim->differs->data, 0, sim->differs->len);
	if (!compare_rungs(project, board, take_pair, sim) ||
	    compare_each(project, board, take_difference, sim) < 0)
		g_error("out of memory");
	number_charts(sim, project);
}

static int find_rung(LadderSim *sim, int pou, int rung)
{
	const GArray *of = rungs_of(sim, pou);

	return of && rung >= 0 && (guint)rung < of->len ? g_array_index(of, int, rung) : -1;
}

/* ---- what is shown ---- */

const struct twin *ladder_sim_twin(LadderSim *sim)
{
	if (!ladder_sim_is_on(sim))
		return NULL;
	return sim->past ? sim_replay_twin(sim->replay) : &sim->view.twin;
}

bool ladder_sim_lateness(LadderSim *sim, struct sim_lateness *out)
{
	if (sim->thread)
		sim_thread_lateness(sim->thread, out);
	return sim->thread != NULL;
}

bool ladder_sim_cost(LadderSim *sim, struct sim_cost *out)
{
	if (!sim->thread)
		return false;
	sim_thread_cost(sim->thread, out);
	return out->scans > 0;
}

int ladder_sim_rung(LadderSim *sim, LadderDocument *document, int pou, int rung)
{
	if (!ladder_sim_is_on(sim))
		return -1;
	if (ladder_sim_older(sim, NULL))
		return document == sim->older ? rung : -1;
	return document == sim->document ? find_rung(sim, pou, rung) : -1;
}

int ladder_sim_pou(LadderSim *sim, LadderDocument *document, int pou)
{
	struct ladder *ladder = ladder_sim_ladder(sim);
	const struct project *mine = ladder_document_project(document);
	const struct project *running = ladder ? ladder_project(ladder) : NULL;
	const char *name;

	if (!mine || !running || pou < 0 || pou >= mine->pou_count)
		return -1;
	name = project_text(mine, mine->pou[pou].name);
	return project_find_pou(running, name, strlen(name));
}

bool ladder_sim_may_miss(LadderSim *sim)
{
	return ladder_sim_board(sim) && !ladder_sim_is_recording(sim);
}

static bool is_other(LadderSim *sim, int part)
{
	const GArray *of = rungs_of(sim, part);

	for (guint i = 0; of && i < of->len; i++)
		if (g_array_index(of, int, i) < 0)
			return true;
	return part + PARTS >= 0 && (guint)(part + PARTS) < sim->differs->len &&
	       sim->differs->data[part + PARTS];
}

bool ladder_sim_is_missing(LadderSim *sim, LadderDocument *document, int pou, int rung)
{
	return ladder_sim_may_miss(sim) && document == sim->document &&
	       (rung < 0 ? is_other(sim, pou) : find_rung(sim, pou, rung) < 0);
}

bool ladder_sim_runs_all_of(LadderSim *sim, LadderDocument *document, int pou)
{
	const struct project *project = ladder_document_project(document);
	bool all = !ladder_sim_is_missing(sim, document, pou, -1) &&
		   !ladder_sim_is_missing(sim, document, SIM_TYPES, -1);

	for (int i = 0; all && project && i < project->pou_count; i++)
		all = project->pou[i].kind == POU_PROGRAM || !ladder_sim_is_missing(sim, document, i, -1);
	return all;
}

bool ladder_sim_knows(LadderSim *sim, struct location at)
{
	return ladder_sim_is_on(sim) && sim->source->knows(sim->source, at);
}

enum sim_quality ladder_sim_quality(LadderSim *sim, struct location at)
{
	if (!ladder_sim_is_on(sim) || at.type == IEC_NONE)
		return SIM_GOOD;
	return sim->source->quality(sim->source, &sim->view, sim->past ? sim->replay : NULL, at);
}

enum sim_quality ladder_sim_replay_quality(LadderSim *sim, const struct sim_replay *replay, struct location at)
{
	if (!ladder_sim_is_on(sim) || !replay->program || at.type == IEC_NONE)
		return SIM_GOOD;
	return sim->source->quality(sim->source, &sim->view, replay, at);
}

bool ladder_sim_has_power(LadderSim *sim, const char *unit)
{
	return ladder_sim_is_on(sim) && sim->source->has_power(sim->source, unit);
}

int ladder_sim_forces(LadderSim *sim)
{
	const struct twin *twin = ladder_sim_twin(sim);

	if (sim->mirror && !sim->past && sim_mirror_forces(sim->mirror) >= 0)
		return sim_mirror_forces(sim->mirror);
	return twin ? twin->resource.image.force_count + twin->plant.image.force_count : 0;
}

bool ladder_sim_replay(LadderSim *sim, struct sim_replay *replay, guint64 scan)
{
	return ladder_sim_is_on(sim) && sim->source->replay(sim->source, replay, scan);
}

/* ---- the past ---- */

static struct sim_program *shown_program(LadderSim *sim)
{
	return sim->past ? sim->replay->program : sim->view.program;
}

struct ladder *ladder_sim_ladder(LadderSim *sim)
{
	const struct sim_program *program = shown_program(sim);

	return program ? program->ladder : NULL;
}

const char *ladder_sim_text(LadderSim *sim)
{
	const struct sim_program *program = shown_program(sim);

	return program ? program->text : NULL;
}

struct ladder *ladder_sim_plant_ladder(LadderSim *sim)
{
	const struct sim_program *plant = sim->past ? sim->replay->plant : sim->view.plant;

	return plant ? plant->ladder : NULL;
}

static bool is_older(LadderSim *sim)
{
	return sim->past && sim->replay->edited_us;
}

/* All forget the places of the program that was freed before the first of them asks another. */
static void tell_program(LadderSim *sim)
{
	g_signal_emit(sim, signals[PROGRAM_GONE], 0);
	g_signal_emit(sim, signals[PROGRAM_CHANGED], 0);
}

/* After the scan that is shown may have changed. Before: the program that was shown, and whether
 * an edit had replaced it, which is known before the newer one is taken. */
static void tell_shown(LadderSim *sim, const struct sim_program *before, bool older)
{
	if (shown_program(sim) != before || is_older(sim) != older)
		tell_program(sim);
	g_signal_emit(sim, signals[SHOWN], 0);
}

/* Locks the record for one scan at a time, so that the thread does not wait long. */
static bool replay_to(LadderSim *sim, guint64 scan)
{
	bool good;

	do
		good = ladder_sim_replay(sim, sim->replay, scan);
	while (good && sim->replay->replay.twin.scan < scan);
	return good;
}

bool ladder_sim_show(LadderSim *sim, guint64 scan)
{
	struct sim_program *before = sim_program_ref(shown_program(sim));
	const bool older = is_older(sim);
	bool good;

	if (!sim->replay)
		sim->replay = sim_replay_new();
	if (!sim->past)
		ladder_sim_fetch(sim);
	good = replay_to(sim, scan);
	/* A replay that failed on the way may have no program. */
	sim->past = good || (sim->past && sim->replay->program);
	if (good || shown_program(sim) != before)
		tell_shown(sim, before, older);
	sim_program_unref(before);
	return good;
}

void ladder_sim_show_now(LadderSim *sim)
{
	const bool older = is_older(sim);
	struct sim_program *before;

	if (!sim->past)
		return;
	before = sim_program_ref(shown_program(sim));
	sim->past = false;
	tell_shown(sim, before, older);
	sim_program_unref(before);
}

bool ladder_sim_is_past(LadderSim *sim)
{
	return sim->past;
}

static void forget_replay(LadderSim *sim)
{
	sim->past = false;
	g_clear_pointer(&sim->replay, sim_replay_free);
	g_clear_object(&sim->older);
	sim->older_era = 0;
}

/* ---- the record ---- */

static void find_span(LadderSim *sim, guint64 *first, guint64 *last)
{
	*first = *last = 0;
	if (ladder_sim_is_on(sim))
		sim->source->span(sim->source, first, last);
}

guint64 ladder_sim_first(LadderSim *sim)
{
	guint64 first, last;

	find_span(sim, &first, &last);
	return first;
}

guint64 ladder_sim_last(LadderSim *sim)
{
	guint64 first, last;

	find_span(sim, &first, &last);
	return last;
}

bool ladder_sim_computed(LadderSim *sim, guint64 *first, guint64 *last)
{
	if (!ladder_sim_is_on(sim))
		return false;
	if (sim->mirror)
		return sim_mirror_computed(sim->mirror, first, last);
	find_span(sim, first, last);
	return true;
}

void ladder_sim_fetch(LadderSim *sim)
{
	if (ladder_sim_is_on(sim))
		sim->source->past(sim->source);
}

static const struct sim_eras *lock(LadderSim *sim)
{
	return ladder_sim_is_on(sim) ? sim->source->lock(sim->source) : NULL;
}

const struct record *ladder_sim_lock_record(LadderSim *sim)
{
	const struct sim_eras *eras = lock(sim);

	return eras ? sim_eras_newest(eras)->record : NULL;
}

void ladder_sim_unlock_record(LadderSim *sim)
{
	sim->source->unlock(sim->source);
}

/* ---- programs before an edit ---- */

bool ladder_sim_next_edit(LadderSim *sim, guint64 scan, struct sim_edited *out)
{
	const struct sim_eras *eras = lock(sim);
	const struct sim_era *era = eras ? sim_eras_find(eras, scan) : NULL;
	const bool good = era && era->edited_us;

	if (good)
		*out = (struct sim_edited){ record_last(era->record), era->edited_us };
	if (eras)
		sim->source->unlock(sim->source);
	return good;
}

static LadderDocument *older_document(LadderSim *sim, const struct sim_program *program)
{
	LadderDocument *document = ladder_document_new();

	if (ladder_document_path(sim->document))
		ladder_document_open_text(document, ladder_document_path(sim->document), program->text,
					  strlen(program->text), true);
	else
		ladder_document_open_copy(document, ladder_document_file(sim->document), program->text,
					  strlen(program->text), true);
	ladder_document_fix(document);
	return document;
}

LadderDocument *ladder_sim_older(LadderSim *sim, struct sim_edited *edit)
{
	const struct sim_replay *replay = sim->replay;

	if (!sim->past || !replay->edited_us)
		return NULL;
	if (sim->older_era != replay->era) {
		g_clear_object(&sim->older);
		sim->older = older_document(sim, replay->program);
		sim->older_era = replay->era;
	}
	if (edit && !ladder_sim_next_edit(sim, replay->replay.twin.scan, edit))
		*edit = (struct sim_edited){ replay->replay.twin.scan, replay->edited_us };
	return sim->older;
}

guint64 ladder_sim_life(LadderSim *sim)
{
	return sim->life;
}

/* ---- signals ---- */

static void tell_state(LadderSim *sim)
{
	sim->told = ladder_sim_state(sim);
	sim->told_period = ladder_sim_period(sim);
	g_signal_emit(sim, signals[STATE_CHANGED], 0);
}

static void tell(LadderSim *sim, const char *text, bool bad)
{
	g_signal_emit(sim, signals[TOLD], 0, text, bad);
}

static void refuse(LadderSim *sim, struct location at, const char *why)
{
	tell(sim, why, false);
	g_signal_emit(sim, signals[REFUSED], 0, &at, why);
}

/* ---- messages of the thread ---- */

static char *halt_words(const struct sim_program *program, const struct resource *resource)
{
	char *place = sim_place_words(program, &resource->halt_at);
	char *text = g_strdup_printf(_("STOP: the program stopped itself: %s. Outputs have their safe values"),
				     place);

	g_free(place);
	return text;
}

static char *failed_words(const struct sim_program *program, const struct resource *resource,
			  bool faulted)
{
	char *place = sim_place_words(program, &resource->error_at);
	char *text = g_strdup_printf(faulted ?
		_("FAULT: an operation failed, such as a division by zero: %s. Outputs are "
		  "off. Run continues with ENO FALSE, as on a board") :
		_("ENO is FALSE: an operation failed, such as a division by zero: %s"), place);

	g_free(place);
	return text;
}

/* Tells that the program ended in FAULT or STOP, if it has not been started again. */
static void tell_end(LadderSim *sim)
{
	const struct resource *resource = &sim->view.twin.resource;
	char *text;

	if (sim->known.ends == sim->view.events.ends ||
	    (resource->state != STATE_FAULT && !resource->halted))
		return;
	text = resource->state == STATE_FAULT ?
		sim_fault_words(sim->view.program, resource) :
		halt_words(sim->view.program, resource);
	tell(sim, text, true);
	g_free(text);
}

/* A board only sets ENO to FALSE and counts. The simulation stops, so that a person sees
 * it. */
static void tell_failure(LadderSim *sim)
{
	const struct resource *resource = &sim->view.twin.resource;
	const bool faulted = sim->view.events.faulted;
	char *text;

	if (sim->known.failures == sim->view.events.failures || !resource->vm.errors ||
	    resource->state == STATE_FAULT)
		return;
	text = failed_words(sim->view.program, resource, faulted);
	tell(sim, text, faulted);
	g_free(text);
}

static void tell_refusal(LadderSim *sim)
{
	const struct sim_refusal *refusal = &sim->view.refusal;

	if (sim->refused == refusal->count)
		return;
	sim->refused = refusal->count;
	tell(sim, refusal->why == SIM_REFUSED_STALE ?
	     _("Not done: the program has just changed. Try again") :
	     _("Not done: the variable cannot be set or forced, or too many variables are forced already"),
	     false);
}

/* No message if no scan ran before the edit. */
static void tell_edit(LadderSim *sim)
{
	const struct record *record = ladder_sim_lock_record(sim);
	const guint64 scan = record ? record_first(record) : 0;
	char *text;

	if (record)
		ladder_sim_unlock_record(sim);
	if (scan == 0)
		return;
	text = g_strdup_printf(_("The program was changed after scan %llu. Values are kept"), (unsigned long long)scan);
	tell(sim, text, false);
	g_free(text);
}

static void take(LadderSim *sim)
{
	const struct sim_program *before = sim->view.program;
	bool other;

	if (!sim->source->take(sim->source, &sim->view, &other))
		return;
	if (sim->mirror && sim->view.program != before)
		number_rungs(sim);
	if (other) {
		if (!sim->mirror || sim->view.program != before)
			forget_replay(sim);
		tell_program(sim);
		tell_edit(sim);
	}
}

static gboolean notified(gpointer data)
{
	LadderSim *sim = data;

	take(sim);
	tell_end(sim);
	tell_failure(sim);
	sim->known = sim->view.events;
	tell_refusal(sim);
	if (sim->told != ladder_sim_state(sim) ||
	    sim->told_period != ladder_sim_period(sim))
		tell_state(sim);
	if (!sim->past)
		g_signal_emit(sim, signals[SHOWN], 0);
	return G_SOURCE_REMOVE;
}

/* ---- breakpoints and steps ---- */

LadderBreakpoints *ladder_sim_breakpoints(LadderSim *sim)
{
	return sim->points;
}

void ladder_sim_hold_stops(LadderSim *sim, bool hold)
{
	stops_follow_hold(sim->follow, hold);
}

/* In the program that the thread has got last. */
static void give_stops(LadderSim *sim)
{
	if (sim->thread)
		sim_thread_stops(sim->thread, sim_stops_new(sim->newest, sim->document, sim->points));
}

const struct stops_frame *ladder_sim_stack(LadderSim *sim, int *count)
{
	*count = ladder_sim_is_on(sim) && !sim->past ? sim->view.frames : 0;
	return *count ? sim->view.frame : NULL;
}

/* A further instance of a program has the text of its POU. */
int ladder_sim_stack_line(LadderSim *sim, const struct stops_frame *frame, int *pou)
{
	const struct project *ran = ladder_project(sim->view.program->ladder);
	const struct project *project = ladder_document_project(sim->document);
	const struct pou *of = NULL;
	const char *name;

	for (int i = 0; ran && i < ran->pou_count; i++) {
		const struct pou *one = &ran->pou[i];

		if (name_equal(project_text(ran, one->name), frame->at.pou))
			of = one;
	}
	for (int i = 0; ran && !of && i < ran->pou_count; i++)
		if (ran->pou[i].line <= (int)frame->at.line && !ran->pou[i].included &&
		    (i + 1 == ran->pou_count || ran->pou[i + 1].line > (int)frame->at.line))
			of = &ran->pou[i];
	name = of ? project_text(ran, of->name) : "";
	*pou = project ? project_find_pou(project, name, strlen(name)) : -1;
	return *pou < 0 || !frame->at.line ? -1 :
	       sim_stops_shown(sim->view.program, sim->document, *pou, frame->at.line);
}

int ladder_sim_reached(LadderSim *sim, int pou, int line)
{
	return sim->thread && ladder_sim_is_on(sim) ?
	       sim_stops_line(sim->view.program, sim->document, pou, line) : line;
}

static bool goes_out(enum iec_area area)
{
	return area == AREA_Q || area == AREA_AQ || area == AREA_XQ || area == AREA_XAQ;
}

union iec_value ladder_sim_outside(LadderSim *sim, struct location at)
{
	const struct image *image = &ladder_sim_twin(sim)->resource.image;
	const struct areas *areas = &image->program->areas;
	const bool bit = at.area != AREA_NONE;
	int count;

	if (!ladder_sim_stack(sim, &count) ||
	    !goes_out(bit ? at.area : areas_find(areas, at.where)))
		return image_get(image, at);
	if (!bit)
		return iec_load(sim->view.outside + at.where, at.type);
	return (union iec_value){ .i = sim->view.outside[areas->at[at.area] + at.where / 8] >>
				       at.where % 8 & 1 };
}

/* ---- on and off ---- */

static struct sim_program *build(LadderSim *sim,
				 struct sim_program *read_program(struct ladder *, const char *,
								  const char *, gsize, GError **),
				 GError **error)
{
	gsize len;
	char *text = ladder_document_text(sim->document, &len);
	const char *file = ladder_document_file(sim->document);
	struct sim_program *program = read_program(ladder_document_reader(sim->document),
		g_intern_string(*file ? file : "-"), text, len, error);

	/* A list that cannot be read would run differently from its text. */
	if (program && !ladder_document_is_whole(sim->document)) {
		ladder_document_check_now(sim->document);
		sim_program_say_why(ladder_document_project(sim->document),
				    ladder_document_diags(sim->document), error);
		g_clear_pointer(&program, sim_program_unref);
	}
	g_free(text);
	return program;
}

struct sim_program *ladder_sim_build(LadderSim *sim, GError **error)
{
	return build(sim, sim_program_read, error);
}

/* An edit that is built: see below. */
struct rebuild {
	struct ladder *reader;   /* NULL: it was used                          */
	char *text, *form;       /* @form: of the document; NULL: @text          */
	gsize len;
	const char *file;
	guint64 version;         /* of the document that has the text          */
	guint64 life;            /* of the simulation that it is built for     */
	bool foreseen;           /* the document does not have it yet          */
	bool missed;             /* meanwhile it has got another one           */
	struct sim_program *program; /* of `ahead`; NULL: it has errors        */
};

static void rebuild_free(gpointer pointer)
{
	struct rebuild *rebuild = pointer;

	if (!rebuild)
		return;
	ladder_free(rebuild->reader);
	sim_program_unref(rebuild->program);
	g_free(rebuild->text);
	g_free(rebuild->form);
	g_free(rebuild);
}

static void drop_source(LadderSim *sim)
{
	g_clear_handle_id(&sim->soon, g_source_remove);
	g_clear_pointer(&sim->ahead, rebuild_free);
	if (sim->source)
		sim->source->free(sim->source);
	sim->source = NULL;
	sim->thread = NULL;
	sim->mirror = NULL;
	sim->late_ns = 0;
	sim_view_clear(&sim->view);
	sim->refused = 0;
	sim->known = (struct sim_events){ .ends = 0 };
}

static bool start_thread(LadderSim *sim, struct sim_program *program, gint64 period_ns,
			 guint64 speed, GError **error)
{
	struct sim_thread *thread = sim_thread_new(program, sim->plant, period_ns, speed,
						   notified, sim);

	if (!thread) {
		g_set_error_literal(error, G_IO_ERROR, G_IO_ERROR_FAILED,
				    _("Out of memory"));
		return false;
	}
	drop_source(sim);
	sim->thread = thread;
	sim->source = sim_thread_source(thread);
	sim->life++;
	sim_program_unref(sim->newest);
	sim->newest = sim_program_ref(program);
	if (sim->speed > 0)
		sim_thread_speed(sim->thread, sim->speed);
	sim_thread_fault_on_error(sim->thread, sim->fault_on_error);
	sim->version = ladder_document_version(sim->document);
	give_stops(sim);
	number_rungs(sim);
	take(sim);
	return true;
}

static bool may_restart(LadderSim *sim, GError **error)
{
	const char *why = ladder_sim_why_not(sim, SIM_WISH_RESTART);

	if (why)
		g_set_error_literal(error, G_IO_ERROR, G_IO_ERROR_NOT_SUPPORTED, why);
	return !why;
}

/* @period_ns: 0: the period that the person set, or that of the tasks. */
static bool start(LadderSim *sim, gint64 period_ns, guint64 speed, GError **error)
{
	struct sim_program *program;
	bool good;

	if (!may_restart(sim, error))
		return false;
	program = build(sim, sim_program_read_listed, error);
	if (!program) {
		ladder_document_check_now(sim->document);
		return false;
	}
	if (!period_ns)
		period_ns = sim->period_ns ? sim->period_ns :
			    tasks_tick(program->program, 0, SIM_PERIOD);
	good = start_thread(sim, program, period_ns, speed, error);
	sim_program_unref(program);
	if (!good)
		return false;
	tell_state(sim);
	g_signal_emit(sim, signals[SHOWN], 0);
	return true;
}

bool ladder_sim_begin(LadderSim *sim, GError **error)
{
	return ladder_sim_is_on(sim) || start(sim, 0, sim->board_speed, error);
}

bool ladder_sim_restart(LadderSim *sim, GError **error)
{
	return start(sim, 0, sim->board_speed, error);
}

bool ladder_sim_play(LadderSim *sim, gint64 period_ns, guint64 speed, GArray *acts,
		     guint64 scans, GError **error)
{
	if (!start(sim, period_ns, speed, error))
		return false;
	sim_thread_play(sim->thread, acts, scans);
	return true;
}

void ladder_sim_end(LadderSim *sim)
{
	if (!sim->source)
		return;
	drop_source(sim);
	forget_replay(sim);
	sim->life++;
	tell_program(sim);
	tell_state(sim);
	g_signal_emit(sim, signals[SHOWN], 0);
}

bool ladder_sim_is_on(LadderSim *sim)
{
	return sim->view.program != NULL;
}

const char *ladder_sim_board(LadderSim *sim)
{
	return sim->mirror && ladder_sim_is_on(sim) ? sim_mirror_name(sim->mirror) : NULL;
}

struct sim_mirror *ladder_sim_mirror_begin(LadderSim *sim, const struct sim_board *board)
{
	ladder_sim_end(sim);
	sim->mirror = sim_mirror_new(board, notified, sim);
	sim->source = sim_mirror_source(sim->mirror);
	sim->life++;
	return sim->mirror;
}

struct sim_program *ladder_sim_program(LadderSim *sim)
{
	return shown_program(sim);
}

bool ladder_sim_follow(LadderSim *sim, LadderSim *of, int pou)
{
	struct sim_program *program = !ladder_sim_is_on(of) || ladder_sim_older(of, NULL) ? NULL :
				      build(sim, sim_program_read_listed, NULL);
	struct sim_shadow *shadow;

	if (!program)
		return false;
	ladder_sim_end(sim);
	shadow = sim_shadow_new(sim, of, program, pou, notified);
	sim->source = sim_shadow_source(shadow);
	sim->life++;
	number_rungs(sim);
	sim_shadow_begin(shadow);
	sim_program_unref(program);
	return true;
}

bool ladder_sim_is_recording(LadderSim *sim)
{
	return sim->mirror && sim_mirror_plays(sim->mirror);
}

void ladder_sim_mirror_refuse(LadderSim *sim, struct location at, const char *why)
{
	if (at.type == IEC_NONE)
		tell(sim, why, false);
	else
		refuse(sim, at, why);
}

void ladder_sim_mirror_forces(LadderSim *sim, int count)
{
	if (sim->mirror && sim_mirror_set_forces(sim->mirror, count) && ladder_sim_is_on(sim))
		tell_state(sim);
}

void ladder_sim_mirror_late(LadderSim *sim, gint64 ns)
{
	if (sim->late_ns == ns)
		return;
	sim->late_ns = ns;
	tell_state(sim);
}

gint64 ladder_sim_late(LadderSim *sim)
{
	return ladder_sim_board(sim) ? sim->late_ns : 0;
}

static struct sim_program *read_plant(const char *path, GError **error)
{
	gsize len;
	char *text = disk_read(path, LIMIT_TEXT, &len, error);
	struct sim_program *plant;

	if (!text)
		return NULL;
	plant = sim_program_new(g_intern_string(path), text, len, error);
	if (!plant)
		g_prefix_error(error, "%s: ", path);
	g_free(text);
	return plant;
}

bool ladder_sim_set_plant(LadderSim *sim, const char *path, GError **error)
{
	struct sim_program *plant;
	const bool on = ladder_sim_is_on(sim);

	if (!may_restart(sim, error))
		return false;
	plant = path ? read_plant(path, error) : NULL;
	if (path && !plant)
		return false;
	ladder_sim_end(sim);
	g_clear_pointer(&sim->plant, sim_program_unref);
	sim->plant = plant;
	g_free(sim->plant_path);
	sim->plant_path = g_strdup(path);
	if (!on)
		tell_state(sim);
	return !on || ladder_sim_begin(sim, error);
}

const char *ladder_sim_plant(LadderSim *sim)
{
	return sim->plant_path;
}

/* ---- an edit while it runs ---- */

static void rebuild_run(GTask *task, gpointer source, gpointer data,
			GCancellable *cancellable)
{
	struct rebuild *rebuild = data;
	struct sim_program *program = sim_program_read_listed(g_steal_pointer(&rebuild->reader),
		rebuild->file, rebuild->text, rebuild->len, NULL);

	(void)source;
	(void)cancellable;
	g_task_return_pointer(task, program, (GDestroyNotify)sim_program_unref);
}

static void build_edit(LadderSim *sim);

/* Changes of the VIEW part, such as bookmarks, do not replace the program. */
static void exchange(LadderSim *sim, struct sim_program *program)
{
	if (sim_program_is_same(sim->newest, program))
		return;
	if (sim->view.frames)
		tell(sim, _("The program was changed. The scan that had stopped was finished with the old program"),
		     false);
	sim_thread_change(sim->thread, program);
	sim_program_unref(sim->newest);
	sim->newest = sim_program_ref(program);
	give_stops(sim);
}

/* The document has the text of @rebuild. */
static void use(LadderSim *sim, struct rebuild *rebuild)
{
	struct sim_program *program = rebuild->program;

	if (program && rebuild->form)
		sim_program_set_form(program, g_steal_pointer(&rebuild->form));
	if (program && sim->thread) {
		exchange(sim, program);
		sim->version = rebuild->version;
	}
	if (rebuild->version != ladder_document_version(sim->document))
		build_edit(sim);
	else if (program)
		number_rungs(sim);
}

static void rebuilt(GObject *object, GAsyncResult *result, gpointer unused)
{
	LadderSim *sim = LADDER_SIM(object);
	struct rebuild *rebuild = g_steal_pointer(&sim->building);

	(void)unused;
	rebuild->program = g_task_propagate_pointer(G_TASK(result), NULL);
	if (rebuild->foreseen && sim->thread && !rebuild->missed) {
		sim->ahead = rebuild;
		return;
	}
	/* A simulation that began meanwhile has a newer text already. */
	if (!rebuild->foreseen && rebuild->life == sim->life)
		use(sim, rebuild);
	else
		build_edit(sim);
	rebuild_free(rebuild);
}

/* An edit may have made a rung what it is on the board again. */
static void number_again(LadderSim *sim)
{
	GPtrArray *before = sim->rungs;
	GBytes *differed = g_bytes_new(sim->differs->data, sim->differs->len);
	bool same;

	sim->rungs = g_ptr_array_new_with_free_func((GDestroyNotify)g_array_unref);
	number_rungs(sim);
	same = before->len == sim->rungs->len &&
	       g_bytes_get_size(differed) == sim->differs->len &&
	       memcmp(g_bytes_get_data(differed, NULL), sim->differs->data, sim->differs->len) == 0;
	for (guint i = 0; same && i < before->len; i++) {
		const GArray *a = before->pdata[i], *b = sim->rungs->pdata[i];

		same = a->len == b->len && memcmp(a->data, b->data, a->len * sizeof(int)) == 0;
	}
	g_ptr_array_unref(before);
	g_bytes_unref(differed);
	if (!same && ladder_sim_is_on(sim))
		tell_program(sim);
}

/* A text that did not come: the next ones may not come either, and a build in vain takes as long as the
 * other. */
#define RESTS 20

/* @text: taken. */
static void build_text(LadderSim *sim, char *text, gsize len, guint64 version, bool foreseen)
{
	struct rebuild *rebuild = g_new0(struct rebuild, 1);
	GTask *task;

	rebuild->reader = ladder_document_reader(sim->document);
	rebuild->text = text;
	rebuild->len = len;
	rebuild->file = g_intern_string(*ladder_document_file(sim->document) ?
					ladder_document_file(sim->document) : "-");
	rebuild->version = version;
	rebuild->foreseen = foreseen;
	rebuild->life = sim->life;
	sim->building = rebuild;
	task = g_task_new(sim, NULL, rebuilt, NULL);
	g_task_set_task_data(task, rebuild, NULL);
	g_task_run_in_thread(task, rebuild_run);
	g_object_unref(task);
}

/* Is the text that was built ahead now that of the document, or of its file? By one change only: more
 * of them may have changed the files beside it. */
static bool came_true(LadderSim *sim, struct rebuild *rebuild, const char *text)
{
	if (!rebuild || !rebuild->foreseen ||
	    rebuild->version + 1 != ladder_document_version(sim->document))
		return false;
	if (strcmp(rebuild->text, text) != 0) {
		if (!ladder_document_took(sim->document, rebuild->text))
			return false;
		rebuild->form = g_strdup(text);
	}
	rebuild->version++;
	rebuild->life = sim->life;
	rebuild->foreseen = false;
	return true;
}

/* Builds the document in a thread, if it has changed. One with errors does not replace the
 * program that runs. */
static void build_edit(LadderSim *sim)
{
	struct rebuild *ahead;
	char *text;
	gsize len;

	if (!sim->thread || (sim->building && !sim->building->foreseen) ||
	    !ladder_document_is_whole(sim->document) ||
	    sim->version == ladder_document_version(sim->document))
		return;
	ahead = g_steal_pointer(&sim->ahead);
	text = ladder_document_text(sim->document, &len);
	if (sim->building) {
		sim->building->missed = !came_true(sim, sim->building, text);
		sim->rest = sim->building->missed ? RESTS : sim->rest;
		g_free(text);
	} else if (came_true(sim, ahead, text)) {
		g_free(text);
		use(sim, ahead);
	} else {
		sim->rest = ahead ? RESTS : sim->rest;
		build_text(sim, text, len, ladder_document_version(sim->document), false);
	}
	rebuild_free(ahead);
}

void ladder_sim_foresee(LadderSim *sim, char *text)
{
	const bool rests = sim->rest > 0;

	sim->rest -= rests;
	if (rests || !text || !sim->thread || sim->building || !ladder_document_is_whole(sim->document)) {
		g_free(text);
		return;
	}
	g_clear_pointer(&sim->ahead, rebuild_free);
	build_text(sim, text, strlen(text), ladder_document_version(sim->document), true);
}

bool ladder_sim_is_building(LadderSim *sim)
{
	return sim->building != NULL;
}

static gboolean build_now(gpointer data)
{
	LadderSim *sim = data;

	sim->soon = 0;
	build_edit(sim);
	return G_SOURCE_REMOVE;
}

/* A changed list is built before the views show the change. */
static void read_anew(LadderSim *sim)
{
	forget_rungs(sim);
	if (!sim->mirror)
		build_edit(sim);
}

/* An edit is built as soon as all of its changes are done, not when the problems of the document
 * are known, which waits until a person has stopped typing. */
static void edited(LadderSim *sim)
{
	if (sim->thread && !sim->mirror && !sim->soon)
		sim->soon = g_idle_add_full(G_PRIORITY_DEFAULT, build_now, sim, NULL);
}

/* Also files beside the document may have changed since. */
static void checked(LadderSim *sim)
{
	if (sim->mirror)
		number_again(sim);
	else if (!ladder_document_diags(sim->document)->errors)
		build_edit(sim);
}

/* ---- running ---- */

enum sim_state ladder_sim_state(LadderSim *sim)
{
	if (!ladder_sim_is_on(sim))
		return SIM_OFF;
	switch (sim->view.twin.resource.state) {
	case STATE_STOP: return SIM_STOP;
	case STATE_FAULT: return SIM_FAULT;
	case STATE_RUN: break;
	}
	return sim->view.running ? SIM_RUN : sim->view.fault ? SIM_FAULT : SIM_PAUSE;
}

const char *ladder_sim_why_not(LadderSim *sim, enum sim_wish wish)
{
	return sim->source ? sim->source->why_not(sim->source, wish) : NULL;
}

/* True after a message that says why not. */
static bool refuses(LadderSim *sim, enum sim_wish wish)
{
	const char *why = ladder_sim_why_not(sim, wish);

	if (why)
		tell(sim, why, false);
	return why != NULL;
}

static void order(LadderSim *sim, enum act_kind kind, gint64 value)
{
	const struct act act = { .kind = kind, .value.i = value };

	if (ladder_sim_is_on(sim))
		sim->source->act(sim->source, NULL, &act, 1);
}

static void start_if_stopped(LadderSim *sim)
{
	if (sim->view.twin.resource.state != STATE_RUN)
		order(sim, sim->mirror ? ACT_WARM : ACT_START, 0);
}

/* May the thread get this order? The newest scan is shown then. */
static bool may_order(LadderSim *sim, enum sim_wish wish)
{
	if (!ladder_sim_is_on(sim) || refuses(sim, wish))
		return false;
	ladder_sim_show_now(sim);
	return true;
}

void ladder_sim_run(LadderSim *sim)
{
	if (!may_order(sim, SIM_WISH_RUN))
		return;
	start_if_stopped(sim);
	if (sim->thread)
		sim_thread_run(sim->thread, true);
}

static bool may_step(LadderSim *sim)
{
	if (!may_order(sim, SIM_WISH_TIME) || !sim->thread)
		return false;
	start_if_stopped(sim);
	return true;
}

void ladder_sim_step(LadderSim *sim, enum stops_step step)
{
	if (may_step(sim))
		sim_thread_step(sim->thread, step);
}

bool ladder_sim_run_to(LadderSim *sim, int pou, int line)
{
	struct sim_stops *stops = sim->thread ?
		sim_stops_new(sim->newest, sim->document, sim->points) : NULL;

	if (!stops || !sim_stops_add(stops, sim->document, pou, line) || !may_step(sim)) {
		sim_stops_free(stops);
		return false;
	}
	sim_thread_stops(sim->thread, stops);
	sim_thread_step(sim->thread, STOPS_GO);
	return true;
}

void ladder_sim_pause(LadderSim *sim)
{
	if (sim->thread)
		sim_thread_run(sim->thread, false);
	else
		refuses(sim, SIM_WISH_TIME);
}

void ladder_sim_stop(LadderSim *sim)
{
	if (!may_order(sim, SIM_WISH_RUN))
		return;
	if (sim->thread)
		sim_thread_run(sim->thread, false);
	order(sim, ACT_STOP, 0);
}

void ladder_sim_scan(LadderSim *sim, int scans)
{
	if (!may_order(sim, SIM_WISH_TIME))
		return;
	start_if_stopped(sim);
	sim_thread_scan(sim->thread, scans);
}

void ladder_sim_reset(LadderSim *sim, bool warm)
{
	if (may_order(sim, SIM_WISH_RUN))
		order(sim, warm ? ACT_WARM : ACT_START, 0);
}

gint64 ladder_sim_period(LadderSim *sim)
{
	return ladder_sim_is_on(sim) ? sim->view.twin.period_ns :
	       sim->period_ns ? sim->period_ns : SIM_PERIOD;
}

void ladder_sim_set_period(LadderSim *sim, gint64 ns)
{
	if (refuses(sim, SIM_WISH_TIME))
		return;
	sim->period_ns = CLAMP(ns, 100000, 60000000000);
	order(sim, ACT_PERIOD, sim->period_ns);
	if (!sim->thread) /* a running thread reports the new period itself */
		tell_state(sim);
}

guint64 ladder_sim_board_speed(LadderSim *sim)
{
	return ladder_sim_is_on(sim) && !sim->mirror ? sim->view.twin.resource.pace.speed :
						       sim->board_speed;
}

void ladder_sim_set_board_speed(LadderSim *sim, guint64 words)
{
	if (refuses(sim, SIM_WISH_TIME))
		return;
	sim->board_speed = MIN(words, PACE_SPEED_MOST);
	order(sim, ACT_SPEED, (gint64)sim->board_speed);
	if (!sim->thread) /* a running thread reports the new speed itself */
		tell_state(sim);
}

double ladder_sim_speed(LadderSim *sim)
{
	return sim->speed;
}

void ladder_sim_set_speed(LadderSim *sim, double scans)
{
	if (refuses(sim, SIM_WISH_TIME))
		return;
	sim->speed = scans > 0 ? scans : 0;
	if (sim->thread)
		sim_thread_speed(sim->thread, sim->speed);
	tell_state(sim);
}

bool ladder_sim_fault_on_error(LadderSim *sim)
{
	return sim->fault_on_error;
}

void ladder_sim_set_fault_on_error(LadderSim *sim, bool fault)
{
	sim->fault_on_error = fault;
	if (sim->thread)
		sim_thread_fault_on_error(sim->thread, fault);
	tell_state(sim);
}

void ladder_sim_act(LadderSim *sim, const struct act *act)
{
	ladder_sim_act_all(sim, act, 1);
}

void ladder_sim_act_all(LadderSim *sim, const struct act *acts, int count)
{
	const char *why;

	if (!ladder_sim_is_on(sim) || count == 0)
		return;
	why = ladder_sim_why_not(sim, acts->kind == ACT_SET ? SIM_WISH_SET : SIM_WISH_FORCE);
	if (why) {
		ladder_sim_mirror_refuse(sim, acts->kind == ACT_RELEASE_ALL ?
			(struct location){ .type = IEC_NONE } : acts->at, why);
		return;
	}
	if (ladder_sim_older(sim, NULL)) {
		tell(sim, _("Not done: this scan ran the program before an edit. Show the newest "
			    "scan first"), false);
		return;
	}
	ladder_sim_show_now(sim);
	sim->source->act(sim->source, acts->plant ? sim->view.plant : sim->view.program, acts, count);
}

void ladder_sim_release_all(LadderSim *sim)
{
	struct act act = { .kind = ACT_RELEASE_ALL };

	ladder_sim_act(sim, &act);
	act.plant = true;
	if (ladder_sim_is_on(sim) && sim->view.plant)
		ladder_sim_act(sim, &act);
}

/* ---- the object ---- */

static void ladder_sim_dispose(GObject *object)
{
	LadderSim *sim = LADDER_SIM(object);

	drop_source(sim);
	forget_replay(sim);
	g_clear_pointer(&sim->plant, sim_program_unref);
	g_clear_pointer(&sim->newest, sim_program_unref);
	g_clear_pointer(&sim->follow, stops_follow_free);
	if (sim->document)
		g_signal_handlers_disconnect_by_data(sim->document, sim);
	g_clear_pointer(&sim->rungs, g_ptr_array_unref);
	g_clear_pointer(&sim->differs, g_byte_array_unref);
	g_clear_object(&sim->document);
	G_OBJECT_CLASS(ladder_sim_parent_class)->dispose(object);
}

static void ladder_sim_finalize(GObject *object)
{
	g_free(LADDER_SIM(object)->plant_path);
	g_object_unref(LADDER_SIM(object)->points);
	G_OBJECT_CLASS(ladder_sim_parent_class)->finalize(object);
}

static void ladder_sim_class_init(LadderSimClass *class)
{
	const GType type = G_TYPE_FROM_CLASS(class);

	G_OBJECT_CLASS(class)->dispose = ladder_sim_dispose;
	G_OBJECT_CLASS(class)->finalize = ladder_sim_finalize;
	signals[STATE_CHANGED] = g_signal_new("state-changed", type, G_SIGNAL_RUN_LAST, 0,
		NULL, NULL, NULL, G_TYPE_NONE, 0);
	signals[PROGRAM_GONE] = g_signal_new("program-gone", type, G_SIGNAL_RUN_LAST,
		0, NULL, NULL, NULL, G_TYPE_NONE, 0);
	signals[PROGRAM_CHANGED] = g_signal_new("program-changed", type, G_SIGNAL_RUN_LAST,
		0, NULL, NULL, NULL, G_TYPE_NONE, 0);
	signals[SHOWN] = g_signal_new("shown", type, G_SIGNAL_RUN_LAST, 0, NULL, NULL,
		NULL, G_TYPE_NONE, 0);
	signals[REFUSED] = g_signal_new("refused", type, G_SIGNAL_RUN_LAST, 0, NULL, NULL, NULL,
					G_TYPE_NONE, 2, G_TYPE_POINTER, G_TYPE_STRING);
	signals[TOLD] = g_signal_new("told", type, G_SIGNAL_RUN_LAST, 0, NULL, NULL, NULL,
		G_TYPE_NONE, 2, G_TYPE_STRING, G_TYPE_BOOLEAN);
}

static void ladder_sim_init(LadderSim *sim)
{
	sim->told = SIM_OFF;
	sim->rungs = g_ptr_array_new_with_free_func((GDestroyNotify)g_array_unref);
	sim->differs = g_byte_array_new();
	sim->fault_on_error = true;
	sim->points = ladder_breakpoints_new();
	g_signal_connect_swapped(sim->points, "changed", G_CALLBACK(give_stops), sim);
}

LadderDocument *ladder_sim_document(LadderSim *sim)
{
	return sim->document;
}

LadderSim *ladder_sim_new(LadderDocument *document)
{
	LadderSim *sim = g_object_new(LADDER_TYPE_SIM, NULL);

	sim->document = g_object_ref(document);
	sim->follow = stops_follow_new(document, sim->points);
	g_signal_connect_swapped(document, "rungs-changed", G_CALLBACK(rungs_changed), sim);
	g_signal_connect_swapped(document, "project-changed", G_CALLBACK(read_anew), sim);
	g_signal_connect_swapped(document, "state-changed", G_CALLBACK(edited), sim);
	g_signal_connect_swapped(document, "checked", G_CALLBACK(checked), sim);
	return sim;
}
