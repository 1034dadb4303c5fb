/* SPDX-License-Identifier: MIT
 *
 * sim_shadow - follows another simulation, scan by scan; see sim_shadow.h.
 *
 * Scans that can be computed again are run one by one, so that edges and the bits of a chart are right. Of a board that
 * sends values alone, the state is taken as it is (trial/shadow.h, @alone).
 */
#include "editor-gtk/sim/sim_shadow.h"

#include "editor-gtk/kit/i18n.h"
#include "editor-gtk/kit/name_fold.h"
#include "editor-gtk/sim/sim_mirror.h"

#include "engine/trial/shadow.h"

#include <string.h>

/* Scans before the one that is shown that are run first, when the shadow begins; after a gap; for a chart, which
 * measures times. */
#define SCANS_BEGIN 200
#define SCANS_GAP 20
#define SCANS_CHART 2000

struct sim_shadow {
	struct sim_source source;
	LadderSim *sim;            /* borrowed: it owns this                      */
	LadderSim *of;             /* referenced                                  */
	struct sim_program *program; /* of the document of @sim                   */
	struct sim_program *runs;  /* of @of; NULL: none yet                      */
	int pou;
	GSourceFunc notify;
	struct shadow *shadow;     /* of both; NULL: none yet                     */
	bool still;                /* of @shadow                                  */
	struct twin twin;          /* what is shown                               */
	struct twin before, now;   /* of @runs                                    */
	struct sim_replay *replay;
	GArray *needs;             /* of struct location, of @runs: what the text names */
	guint64 at;                /* the scan that the shadow has run; 0: none   */
	guint64 life;              /* of @of                                      */
	bool chart;                /* a chart that runs is shown as a ladder      */
	bool powered;              /* power is known                              */
	bool other;                /* something became known: places are to be found again */
};

static struct sim_shadow *shadow_of(struct sim_source *source)
{
	return (struct sim_shadow *)source;
}

/* ---- which values the text names ---- */

static void add_word(GHashTable *words, const char *from, const char *to)
{
	char *word = g_strndup(from, (gsize)(to - from)), *key = name_fold(word);

	g_hash_table_add(words, key);
	g_free(word);
}

static bool in_word(const char *at)
{
	return g_ascii_isalnum(*at) || *at == '_' || *at < 0;
}

/* Names of a text, folded; addresses from their % on. */
static GHashTable *words_of(const char *text, const char *end)
{
	GHashTable *words = g_hash_table_new_full(g_str_hash, g_str_equal, g_free, NULL);

	while (text < end) {
		const char *from = text;

		if (*text == '%')
			text++;
		while (text < end && (in_word(text) || (*from == '%' && *text == '.')))
			text++;
		if (text > from + (*from == '%'))
			add_word(words, from, text);
		else
			text = from + 1;
	}
	return words;
}

/* "Line.Delay.Q" and "List[3]" are known by each of their names. */
static bool has_name(GHashTable *words, const char *name)
{
	char *key = name_fold(name);
	char **parts = g_strsplit_set(key, ".[", -1);
	bool found = false;

	for (int i = 0; parts[i] && !found; i++)
		found = g_hash_table_contains(words, parts[i]);
	g_strfreev(parts);
	g_free(key);
	return found;
}

static void find_needs(struct sim_shadow *shadow, const struct image *image)
{
	LadderDocument *document = ladder_sim_document(shadow->sim);
	struct text_span span;
	char *text = ladder_document_pou(document, shadow->pou, &span);
	GHashTable *words = words_of(text + span.at, text + span.at + span.len);
	struct symbol_cursor cursor = { .whole = true };
	struct symbol symbol;
	GHashTableIter iter;
	gpointer key;

	g_array_set_size(shadow->needs, 0);
	while (image_next_symbol(image, &cursor, &symbol))
		if (!symbol.at.constant && !(symbol.flags & SYMBOL_HIDDEN) && has_name(words, symbol.name))
			g_array_append_val(shadow->needs, symbol.at);
	g_hash_table_iter_init(&iter, words);
	while (g_hash_table_iter_next(&iter, &key, NULL)) {
		const struct location at = *(char *)key == '%' ? image_find(image, key, strlen(key)) :
					   (struct location){ .type = IEC_NONE };

		if (at.type != IEC_NONE)
			g_array_append_val(shadow->needs, at);
	}
	g_hash_table_unref(words);
	g_free(text);
}

static bool knows_needs(struct sim_shadow *shadow)
{
	bool all = true;

	for (guint i = 0; i < shadow->needs->len; i++)
		all = ladder_sim_knows(shadow->of, g_array_index(shadow->needs, struct location, i)) && all;
	return all;
}

/* ---- the program that is followed ---- */

static void forget_program(struct sim_shadow *shadow)
{
	g_clear_pointer(&shadow->shadow, shadow_free);
	if (shadow->runs) {
		twin_free(&shadow->before);
		twin_free(&shadow->now);
	}
	g_clear_pointer(&shadow->runs, sim_program_unref);
	g_clear_pointer(&shadow->replay, sim_replay_free);
	shadow->at = 0;
	shadow->powered = false;
}

/* Has a chart of the program that runs become another language in @shown? */
static bool has_left_chart(const struct project *runs, const struct project *shown)
{
	for (int i = 0; i < runs->pou_count; i++) {
		const char *name = project_text(runs, runs->pou[i].name);
		const int pou = runs->pou[i].sfc ? project_find_pou(shown, name, strlen(name)) : -1;

		if (runs->pou[i].sfc && (pou < 0 || !shown->pou[pou].sfc))
			return true;
	}
	return false;
}

/* Does the board send no more than values, in the scan that is shown? */
static bool is_still(struct sim_shadow *shadow, guint64 scan)
{
	guint64 first, last;

	return ladder_sim_board(shadow->of) && !ladder_sim_is_recording(shadow->of) &&
	       !(ladder_sim_computed(shadow->of, &first, &last) && scan > first && scan <= last);
}

static bool take_program(struct sim_shadow *shadow, const struct twin *twin, bool still)
{
	struct sim_program *runs = ladder_sim_program(shadow->of);
	const struct project *project = ladder_project(shadow->program->ladder);
	const char *name = shadow->pou < project->pou_count ? project_text(project, project->pou[shadow->pou].name) : "";

	if (shadow->runs == runs && shadow->still == still)
		return true;
	forget_program(shadow);
	shadow->shadow = shadow_new(shadow->program->program, runs->program, still ? name : NULL);
	if (!shadow->shadow || !twin_clone(&shadow->before, twin) || !twin_clone(&shadow->now, twin))
		g_error("out of memory");
	shadow->runs = sim_program_ref(runs);
	shadow->still = still;
	shadow->replay = sim_replay_new();
	shadow->chart = has_left_chart(ladder_project(runs->ladder), project);
	shadow->other = true;
	if (still)
		find_needs(shadow, &twin->resource.image);
	return true;
}

/* ---- acts between scans ---- */

struct timed_act { guint64 after; struct act act; };

static bool changes_values(const struct act *act)
{
	return act->kind == ACT_SET || act->kind == ACT_FORCE || act->kind == ACT_RELEASE || act->kind == ACT_RELEASE_ALL;
}

/* Texts belong to the record. */
static void take_act(void *context, guint64 after, const struct act *act)
{
	const struct timed_act one = { after, *act };

	if (changes_values(act) && !act->plant && act->at.type != IEC_STRING)
		g_array_append_val((GArray *)context, one);
}

/* The first scan that the program that runs can be followed from. */
static guint64 find_acts(struct sim_shadow *shadow, guint64 scan, guint64 most, GArray *acts)
{
	guint64 first = ladder_sim_first(shadow->of);
	const struct record *record = ladder_sim_lock_record(shadow->of);

	if (record)
		first = record_first(record);
	first = MAX(first, scan > most ? scan - most : 0);
	if (shadow->at >= first && shadow->at < scan)
		first = shadow->at;
	if (record)
		record_each_act(record, first, take_act, acts);
	if (record)
		ladder_sim_unlock_record(shadow->of);
	return first;
}

static void do_acts(struct twin *twin, GArray *acts)
{
	for (guint i = 0; i < acts->len; i++)
		if (g_array_index(acts, struct timed_act, i).after == twin->scan)
			twin_act(twin, &g_array_index(acts, struct timed_act, i).act);
}

static bool replay_to(struct sim_shadow *shadow, guint64 scan, struct twin *out)
{
	bool good;

	do
		good = ladder_sim_replay(shadow->of, shadow->replay, scan);
	while (good && sim_replay_twin(shadow->replay)->scan < scan);
	good = good && sim_replay_twin(shadow->replay)->scan == scan &&
	       sim_replay_twin(shadow->replay)->resource.image.program == shadow->runs->program;
	if (good)
		twin_copy(out, sim_replay_twin(shadow->replay));
	return good;
}

/* ---- following ---- */

/* How many scans before @scan are run first. A step back keeps what was measured. */
static guint64 scans_before(const struct sim_shadow *shadow, guint64 scan)
{
	const bool step_back = shadow->at > scan && shadow->at - scan <= SCANS_GAP;

	return shadow->chart && !step_back ? SCANS_CHART : shadow->at ? SCANS_GAP : SCANS_BEGIN;
}

/* Runs all scans up to the one that is shown. */
static bool run_scans(struct sim_shadow *shadow, const struct twin *twin)
{
	GArray *acts = g_array_new(FALSE, FALSE, sizeof(struct timed_act));
	const guint64 first = find_acts(shadow, twin->scan, scans_before(shadow, twin->scan), acts);
	bool good = replay_to(shadow, first, &shadow->now);

	if (good && first != shadow->at)
		shadow_jump(shadow->shadow, &shadow->now);
	for (guint64 scan = first + 1; good && scan <= twin->scan; scan++) {
		twin_copy(&shadow->before, &shadow->now);
		do_acts(&shadow->before, acts);
		good = replay_to(shadow, scan, &shadow->now);
		if (good)
			shadow_scan(shadow->shadow, &shadow->before, &shadow->now);
	}
	g_array_unref(acts);
	return good;
}

static void copy_out(struct sim_shadow *shadow, const struct twin *of)
{
	const struct fault_place nowhere = { .pou = "" };
	struct resource *to = &shadow->twin.resource;
	const struct resource *from = shadow_resource(shadow->shadow);
	guint8 *memory = to->image.memory;

	*to = *from;
	to->image.program = shadow->program->program;
	to->image.memory = to->vm.memory = memory;
	to->vm.program = shadow->program->program;
	memcpy(memory, from->image.memory, image_memory_size(shadow->program->program));
	to->fault_at = to->halt_at = to->error_at = nowhere;
	shadow->twin.now_ns = of->now_ns;
	shadow->twin.period_ns = of->period_ns;
	shadow->twin.scan = of->scan;
}

static void look(struct sim_shadow *shadow)
{
	const struct twin *twin = ladder_sim_twin(shadow->of);
	const bool powered = shadow->powered;
	bool still, known;

	if (!twin || ladder_sim_older(shadow->of, NULL))
		return;
	still = is_still(shadow, twin->scan);
	if (!take_program(shadow, twin, still))
		return;
	if (shadow->life != ladder_sim_life(shadow->of))
		shadow->at = 0;
	shadow->life = ladder_sim_life(shadow->of);
	known = !still || knows_needs(shadow);
	if (twin->scan != shadow->at && !twin->resource.standing && !twin->resource.stopped && known) {
		if (still)
			shadow->powered = shadow_scan(shadow->shadow, NULL, twin);
		else
			shadow->powered = twin->scan > 0 && run_scans(shadow, twin);
		shadow->at = twin->scan;
	}
	shadow->powered = shadow->powered && known;
	shadow_values(shadow->shadow, twin);
	copy_out(shadow, twin);
	shadow->other |= shadow->powered != powered;
	shadow->notify(shadow->sim);
}

static void program_gone(struct sim_shadow *shadow)
{
	shadow->at = 0;
}

static void program_changed(struct sim_shadow *shadow)
{
	shadow->other = true;
	look(shadow);
}

/* ---- as a source ---- */

static void free_source(struct sim_source *source)
{
	struct sim_shadow *shadow = shadow_of(source);

	g_signal_handlers_disconnect_by_data(shadow->of, shadow);
	forget_program(shadow);
	twin_free(&shadow->twin);
	g_array_unref(shadow->needs);
	sim_program_unref(shadow->program);
	g_object_unref(shadow->of);
	g_free(shadow);
}

static bool take(struct sim_source *source, struct sim_view *view, bool *other)
{
	struct sim_shadow *shadow = shadow_of(source);
	const enum sim_state state = ladder_sim_state(shadow->of);

	*other = view->program != shadow->program || shadow->other;
	shadow->other = false;
	if (view->program != shadow->program) {
		sim_view_clear(view);
		view->program = sim_program_ref(shadow->program);
		if (!twin_clone(&view->twin, &shadow->twin))
			g_error("out of memory");
	}
	twin_copy(&view->twin, &shadow->twin);
	view->running = state == SIM_RUN;
	view->fault = state == SIM_FAULT;
	return true;
}

static void act(struct sim_source *source, struct sim_program *of, const struct act *acts, int count)
{
	struct sim_shadow *shadow = shadow_of(source);
	struct act *own = g_memdup2(acts, (gsize)count * sizeof(*acts));
	bool good = shadow->shadow != NULL;

	(void)of;
	for (int i = 0; good && i < count; i++) {
		own[i].at = shadow_place(shadow->shadow, acts[i].at);
		good = own[i].at.type != IEC_NONE || acts[i].at.type == IEC_NONE;
	}
	if (good)
		ladder_sim_act_all(shadow->of, own, count);
	else
		ladder_sim_mirror_refuse(shadow->sim, acts->at,
			_("Not done: only the converted program has this variable"));
	g_free(own);
}

static const char *why_not(struct sim_source *source, enum sim_wish wish)
{
	return ladder_sim_why_not(shadow_of(source)->of, wish);
}

static bool replay(struct sim_source *source, struct sim_replay *replay, guint64 scan)
{
	(void)source;
	(void)replay;
	(void)scan;
	return false;
}

static void span(struct sim_source *source, guint64 *first, guint64 *last)
{
	*first = *last = shadow_of(source)->twin.scan;
}

static const struct sim_eras *lock(struct sim_source *source)
{
	(void)source;
	return NULL;
}

static void unlock(struct sim_source *source)
{
	(void)source;
}

static bool knows(struct sim_source *source, struct location at)
{
	struct sim_shadow *shadow = shadow_of(source);
	struct location place;

	at = location_whole(at);
	place = at.constant || !shadow->shadow ? (struct location){ .type = IEC_NONE } : shadow_place(shadow->shadow, at);
	return place.type == IEC_NONE ? at.constant || !shadow->still || shadow->powered :
	       ladder_sim_knows(shadow->of, place);
}

/* The past of both is at one scan: past(). */
static enum sim_quality quality(struct sim_source *source, const struct sim_view *view,
				const struct sim_replay *replay, struct location at)
{
	struct sim_shadow *shadow = shadow_of(source);

	(void)view;
	(void)replay;
	return shadow->shadow ? ladder_sim_quality(shadow->of, shadow_place(shadow->shadow, location_whole(at))) :
	       SIM_GOOD;
}

static bool has_power(struct sim_source *source, const char *unit)
{
	(void)unit;
	return shadow_of(source)->powered;
}

static void past(struct sim_source *source)
{
	ladder_sim_fetch(shadow_of(source)->of);
}

static const struct sim_source as_source = {
	.free = free_source, .take = take, .act = act, .why_not = why_not, .replay = replay, .span = span,
	.lock = lock, .unlock = unlock, .knows = knows, .quality = quality, .has_power = has_power, .past = past,
};

struct sim_shadow *sim_shadow_new(LadderSim *sim, LadderSim *of, struct sim_program *program, int pou,
				  GSourceFunc notify)
{
	struct sim_shadow *shadow = g_new0(struct sim_shadow, 1);

	shadow->source = as_source;
	shadow->sim = sim;
	shadow->of = g_object_ref(of);
	shadow->program = sim_program_ref(program);
	shadow->pou = pou;
	shadow->notify = notify;
	shadow->needs = g_array_new(FALSE, FALSE, sizeof(struct location));
	if (!twin_init(&shadow->twin, program->program, NULL, MAX(ladder_sim_period(of), 1)))
		g_error("out of memory");
	g_signal_connect_swapped(of, "program-gone", G_CALLBACK(program_gone), shadow);
	g_signal_connect_swapped(of, "program-changed", G_CALLBACK(program_changed), shadow);
	g_signal_connect_swapped(of, "shown", G_CALLBACK(look), shadow);
	g_signal_connect_swapped(of, "state-changed", G_CALLBACK(look), shadow);
	return shadow;
}

void sim_shadow_begin(struct sim_shadow *shadow)
{
	look(shadow);
}

struct sim_source *sim_shadow_source(struct sim_shadow *shadow)
{
	return &shadow->source;
}
