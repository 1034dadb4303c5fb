/* SPDX-License-Identifier: MIT
 *
 * sim_mirror - a twin that is filled from outside; see sim_mirror.h.
 *
 * Only what has come is known. A view that asks for something else gets nothing, and its need
 * is stored until it comes.
 */
#include "editor-gtk/sim/sim_mirror.h"

#include "editor-gtk/sim/sim_history.h"

#include "engine/base/name.h"
#include "engine/scan/place.h"

#include <string.h>

#define WANT_MS 50    /* needs of several views are asked for together         */
#define WANTS_MOST 4096 /* needs that are stored                               */

/* From this scan on a value has this quality. */
struct mark {
	guint64 scan;
	enum sim_quality quality;
};

struct sim_mirror {
	struct sim_source source;
	struct sim_board board;
	char *name;
	GSourceFunc notify;
	gpointer notify_data;
	struct twin twin;
	struct sim_history *history;
	guint64 era;             /* no other mirror has it                     */
	gint64 base_ns;          /* of the board's clock: time 0 here          */
	bool begun;              /* a moment has come                          */
	bool plays;              /* a recording: all is known, and nothing comes  */
	guint8 *last_bad;        /* of its last scan, as of struct playback      */
	gsize last_bad_len;
	int forces;              /* as the board counts; -1: not known         */
	bool other;              /* something became known: places are to be found again */
	GHashTable *known;       /* word of a place → enum sim_quality, + 1      */
	GHashTable *marks;       /* word of a place → GArray of struct mark, oldest first */
	GArray *marked;          /* words of places that become another quality at the next moment */
	GHashTable *powered;     /* names of units, of the program             */
	GArray *wants;           /* words of places, the newest last           */
	GPtrArray *units;        /* names, likewise                            */
	guint want_timer, notify_idle;
	/* The board's own record. */
	struct record_file *file; /* NULL: none                                */
	struct playback playback; /* of it                                     */
	bool joined;             /* its end is among what was published: it is shown */
	guint64 before;          /* scans of it before the last start          */
	guint64 first, last;     /* the scans that it has, as they are numbered here */
	gint64 ahead_ns;         /* its time is later than that here           */
};

/* Eras of a thread count from 1. */
static guint64 eras = G_MAXUINT64 / 2;

/* ---- life ---- */

static void drop_record(struct sim_mirror *mirror)
{
	if (!mirror->file)
		return;
	playback_free(&mirror->playback);
	g_clear_pointer(&mirror->file, record_file_free);
	mirror->joined = false;
}

static struct sim_mirror *mirror_of(struct sim_source *source)
{
	return (struct sim_mirror *)source;
}

static void free_source(struct sim_source *source)
{
	struct sim_mirror *mirror = mirror_of(source);

	g_clear_handle_id(&mirror->want_timer, g_source_remove);
	g_clear_handle_id(&mirror->notify_idle, g_source_remove);
	g_hash_table_unref(mirror->known);
	g_hash_table_unref(mirror->marks);
	g_array_unref(mirror->marked);
	g_hash_table_unref(mirror->powered);
	g_array_unref(mirror->wants);
	g_ptr_array_unref(mirror->units);
	drop_record(mirror);
	sim_history_free(mirror->history);
	twin_free(&mirror->twin);
	sim_program_unref(mirror->board.program);
	g_free(mirror->last_bad);
	g_free(mirror->name);
	g_free(mirror);
}

const char *sim_mirror_name(const struct sim_mirror *mirror)
{
	return mirror->name;
}

int sim_mirror_forces(const struct sim_mirror *mirror)
{
	return mirror->forces;
}

bool sim_mirror_set_forces(struct sim_mirror *mirror, int count)
{
	const bool other = mirror->forces != count;

	mirror->forces = count;
	return other;
}

static const struct program *program_of(const struct sim_mirror *mirror)
{
	return mirror->board.program->program;
}

/* ---- as a source ---- */

static bool take(struct sim_source *source, struct sim_view *view, bool *other)
{
	struct sim_mirror *mirror = mirror_of(source);

	*other = false;
	if (!mirror->begun)
		return false;
	*other = view->program != mirror->board.program || mirror->other;
	mirror->other = false;
	if (view->program != mirror->board.program) {
		sim_view_clear(view);
		view->program = sim_program_ref(mirror->board.program);
		if (!twin_clone(&view->twin, &mirror->twin))
			g_error("out of memory");
	}
	twin_copy(&view->twin, &mirror->twin);
	view->running = !mirror->plays;
	view->fault = false;
	return true;
}

static void act(struct sim_source *source, struct sim_program *of, const struct act *acts,
		int count)
{
	struct sim_mirror *mirror = mirror_of(source);

	(void)of;
	mirror->board.act(mirror->board.data, acts, count);
}

static const char *why_not(struct sim_source *source, enum sim_wish wish)
{
	struct sim_mirror *mirror = mirror_of(source);

	return mirror->board.why_not(mirror->board.data, wish);
}

static bool take_era(const struct sim_mirror *mirror, struct sim_replay *replay)
{
	sim_replay_clear(replay);
	if (!twin_clone(&replay->replay.twin, &mirror->twin))
		return false;
	replay->program = sim_program_ref(mirror->board.program);
	replay->era = mirror->era;
	return true;
}

/* Texts and places in a twin of a record are those of another copy of the program. */
static void leave_texts(const struct sim_mirror *mirror, struct twin *twin)
{
	const struct fault_place nowhere = { .pou = "" };
	struct resource *resource = &twin->resource;

	resource->image.program = program_of(mirror);
	resource->fault_at = resource->halt_at = resource->error_at = nowhere;
	twin->safe = NULL;
}

/* The bytes of the playback go with its file. */
static void keep_bad(const struct sim_mirror *mirror, struct sim_replay *replay)
{
	g_free(replay->bad);
	replay->bad_len = mirror->playback.bad_len;
	replay->bad = g_memdup2(mirror->playback.bad, replay->bad_len);
	replay->recorded = true;
}

static bool play(struct sim_mirror *mirror, guint64 scan, struct twin *twin)
{
	gint64 clock;

	if (!playback_seek(&mirror->playback, scan + mirror->before) ||
	    !sim_program_runs(mirror->board.program,
			      mirror->playback.twin.resource.image.program))
		return false;
	twin_copy(twin, &mirror->playback.twin);
	leave_texts(mirror, twin);
	twin->period_ns = mirror->twin.period_ns;
	twin->scan = twin->resource.scans = scan;
	twin->now_ns -= mirror->ahead_ns;
	/* Start and deadlines are of the board's clock. */
	clock = mirror->playback.time_ns - twin->now_ns;
	twin->resource.start_ns -= clock;
	for (guint i = 0; i < program_of(mirror)->task_count; i++)
		twin->resource.tasks.state[i].next_ns -= clock;
	return true;
}

static bool replay(struct sim_source *source, struct sim_replay *replay, guint64 scan)
{
	struct sim_mirror *mirror = mirror_of(source);

	if (replay->era != mirror->era && !take_era(mirror, replay))
		return false;
	if (mirror->joined && scan >= mirror->first && scan <= mirror->last &&
	    play(mirror, scan, &replay->replay.twin)) {
		replay->at = 0; /* not in the history */
		keep_bad(mirror, replay);
		return true;
	}
	replay->recorded = false;
	return sim_history_seek(mirror->history, &replay->at, &replay->replay.twin, scan);
}

static void span(struct sim_source *source, guint64 *first, guint64 *last)
{
	*first = sim_history_first(mirror_of(source)->history);
	*last = sim_history_last(mirror_of(source)->history);
	if (mirror_of(source)->joined)
		*first = MIN(*first, mirror_of(source)->first);
}

static void past(struct sim_source *source)
{
	struct sim_mirror *mirror = mirror_of(source);

	mirror->board.past(mirror->board.data);
}

/* What a board does is not computed here. */
static const struct sim_eras *lock(struct sim_source *source)
{
	(void)source;
	return NULL;
}

static void unlock(struct sim_source *source)
{
	(void)source;
}

/* ---- what views need ---- */

static gboolean ask(gpointer data)
{
	struct sim_mirror *mirror = data;

	mirror->want_timer = 0;
	mirror->board.wanted(mirror->board.data);
	return G_SOURCE_REMOVE;
}

static void ask_soon(struct sim_mirror *mirror)
{
	if (!mirror->want_timer)
		mirror->want_timer = g_timeout_add(WANT_MS, ask, mirror);
}

static bool knows(struct sim_source *source, struct location at)
{
	struct sim_mirror *mirror = mirror_of(source);
	guint32 word;

	at = location_whole(at);
	if (mirror->plays || at.type == IEC_NONE || at.constant)
		return true;
	word = place_word(program_of(mirror), at);
	if (g_hash_table_contains(mirror->known, GUINT_TO_POINTER(word)))
		return true;
	for (guint i = 0; i < mirror->wants->len; i++)
		if (g_array_index(mirror->wants, guint32, i) == word)
			return false;
	if (mirror->wants->len == WANTS_MOST)
		g_array_remove_index(mirror->wants, 0);
	g_array_append_val(mirror->wants, word);
	ask_soon(mirror);
	return false;
}

/* ---- quality ---- */

G_STATIC_ASSERT((int)RECORD_STALE == (int)SIM_STALE && (int)RECORD_BROKEN == (int)SIM_VALUE_FAULT);

static enum sim_quality known_quality(const struct sim_mirror *mirror, gpointer word)
{
	const gpointer found = g_hash_table_lookup(mirror->known, word);

	return found ? (enum sim_quality)(GPOINTER_TO_UINT(found) - 1) : SIM_GOOD;
}

/* As it was at a scan that was published. */
static enum sim_quality quality_at(const struct sim_mirror *mirror, gpointer word, guint64 scan)
{
	const GArray *marks = g_hash_table_lookup(mirror->marks, word);
	guint low = 0, high = marks ? marks->len : 0;

	while (low < high) {
		const guint middle = low + (high - low) / 2;

		if (g_array_index(marks, struct mark, middle).scan <= scan)
			low = middle + 1;
		else
			high = middle;
	}
	return low ? g_array_index(marks, struct mark, low - 1).quality : SIM_GOOD;
}

static enum sim_quality quality(struct sim_source *source, const struct sim_view *view,
				const struct sim_replay *replay, struct location at)
{
	const struct sim_mirror *mirror = mirror_of(source);
	const guint8 *bad = replay ? replay->bad : mirror->last_bad;
	gpointer word;

	(void)view;
	at = location_whole(at);
	if (at.type == IEC_NONE || at.constant)
		return SIM_GOOD;
	if (replay ? replay->recorded : mirror->plays)
		return (enum sim_quality)record_quality_of(bad, replay ? replay->bad_len : mirror->last_bad_len,
							   program_of(mirror), at);
	word = GUINT_TO_POINTER(place_word(program_of(mirror), at));
	return replay ? quality_at(mirror, word, replay->replay.twin.scan) : known_quality(mirror, word);
}

static void forget_marks(struct sim_mirror *mirror)
{
	g_hash_table_remove_all(mirror->marks);
	g_array_set_size(mirror->marked, 0);
}

/* Of what the history has forgotten only the last one is needed. */
static void drop_marks(const struct sim_mirror *mirror, GArray *marks)
{
	const guint64 first = sim_history_first(mirror->history);
	guint count = 0;

	while (count + 1 < marks->len && g_array_index(marks, struct mark, count + 1).scan <= first)
		count++;
	if (count)
		g_array_remove_range(marks, 0, count);
}

/* Values came before the moment that says of which scan they are. */
static void mark_changes(struct sim_mirror *mirror)
{
	for (guint i = 0; i < mirror->marked->len; i++) {
		const gpointer word = GUINT_TO_POINTER(g_array_index(mirror->marked, guint32, i));
		GArray *marks = g_hash_table_lookup(mirror->marks, word);
		const struct mark mark = { mirror->twin.scan, known_quality(mirror, word) };

		if (!marks) {
			marks = g_array_new(FALSE, FALSE, sizeof(struct mark));
			g_hash_table_insert(mirror->marks, word, marks);
		}
		if (marks->len && marks->len % 1024 == 0)
			drop_marks(mirror, marks);
		g_array_append_val(marks, mark);
	}
	g_array_set_size(mirror->marked, 0);
}

/* ---- cells ---- */

/* The cells of a program, or of the body of an instance; `name` of the program image. */
struct unit { const char *name; guint cell, count; guint32 from, size, shift; };

static bool find_cells(const struct program *program, guint pou, struct unit *unit)
{
	unit->count = 0;
	for (guint i = 0; i < program->power_count; i++) {
		if (program->power[i].pou != pou)
			continue;
		if (!unit->count++)
			unit->cell = i;
	}
	return unit->count > 0;
}

static bool find_unit(const struct program *program, const char *name, struct unit *unit)
{
	const gsize len = strlen(name);

	for (guint i = 0; i < program->watched_count; i++) {
		const struct code_watched *watched = &program->watched[i];

		unit->name = program->string + watched->name;
		unit->from = watched->from;
		unit->size = watched->size;
		unit->shift = watched->to - watched->from;
		if (name_is(unit->name, name, len))
			return find_cells(program, watched->pou, unit);
	}
	unit->from = unit->size = unit->shift = 0;
	for (guint i = 0; i < program->entry_count && program->string_bytes; i++) {
		unit->name = program->string + program->entry[i].name;
		if (name_is(unit->name, name, len))
			return find_cells(program, i, unit);
	}
	return false;
}

guint sim_mirror_cells(const struct sim_mirror *mirror, const char *name)
{
	struct unit unit;

	return find_unit(program_of(mirror), name, &unit) ? unit.count : 0;
}

static bool has_power(struct sim_source *source, const char *name)
{
	struct sim_mirror *mirror = mirror_of(source);
	struct unit unit;

	if (mirror->plays || !find_unit(program_of(mirror), name, &unit))
		return true;
	if (g_hash_table_contains(mirror->powered, unit.name))
		return true;
	g_ptr_array_remove(mirror->units, (gpointer)unit.name);
	g_ptr_array_add(mirror->units, (gpointer)unit.name);
	ask_soon(mirror);
	return false;
}

/* Power that is the same for all instances, such as that of the rail, is not copied. */
static guint32 of_instance(const struct unit *unit, guint32 offset)
{
	return offset - unit->from < unit->size ? offset + unit->shift : offset;
}

void sim_mirror_power(struct sim_mirror *mirror, const char *name, const guint8 *bits)
{
	const struct program *program = program_of(mirror);
	guint8 *memory = mirror->twin.resource.image.memory;
	struct unit unit;

	if (!find_unit(program, name, &unit))
		return;
	for (guint i = 0; i < unit.count; i++) {
		const struct code_power *cell = &program->power[unit.cell + i];
		const guint two = bits[i / 4] >> i % 4 * 2 & 3;

		memory[of_instance(&unit, cell->in)] = two & 1;
		if (!cell->type) /* else its value is published as that of a variable */
			memory[of_instance(&unit, cell->out)] = two >> 1 & 1;
	}
	if (g_hash_table_add(mirror->powered, (gpointer)unit.name))
		mirror->other = true;
}

/* ---- choosing the published variables ---- */

struct places {
	const struct program *program;
	GArray *at;              /* of struct location                         */
	GHashTable *words;       /* of these                                   */
	guint most;
	bool all;
};

static void add_place(struct places *places, struct location at)
{
	const gpointer word = GUINT_TO_POINTER(place_word(places->program, at));

	at = location_whole(at);
	if (at.type == IEC_NONE || at.constant || g_hash_table_contains(places->words, word))
		return;
	if (places->at->len == places->most) {
		places->all = false;
		return;
	}
	g_hash_table_add(places->words, word);
	g_array_append_val(places->at, at);
}

static void add_symbols(struct places *places, const struct image *image)
{
	struct symbol_cursor cursor = { .pin = 0 };
	struct symbol symbol;

	while (places->all && image_next_symbol(image, &cursor, &symbol))
		add_place(places, symbol.at);
}

/* The current result after a line of a list, if it is a number. */
static void add_results(struct places *places)
{
	const struct program *program = places->program;

	for (guint i = 0; i < program->power_count && places->all; i++)
		if (program->power[i].type)
			add_place(places, place_locate(program,
				CODE_OPERAND(program->power[i].type, program->power[i].out)));
}

GArray *sim_mirror_places(struct sim_mirror *mirror, guint most, bool *all)
{
	struct places places = {
		.program = program_of(mirror), .most = most, .all = true,
		.at = g_array_new(FALSE, FALSE, sizeof(struct location)),
		.words = g_hash_table_new(NULL, NULL),
	};

	for (guint i = mirror->wants->len; i-- > 0;)
		add_place(&places, place_locate(places.program,
			g_array_index(mirror->wants, guint32, i)));
	add_symbols(&places, &mirror->twin.resource.image);
	add_results(&places);
	g_hash_table_unref(places.words);
	*all = places.all;
	return places.at;
}

static void add_unit(GPtrArray *names, const struct program *program, const char *name,
		     guint most)
{
	struct unit unit;

	if (names->len < most && !g_ptr_array_find(names, name, NULL) &&
	    find_unit(program, name, &unit))
		g_ptr_array_add(names, (gpointer)unit.name);
}

GPtrArray *sim_mirror_units(struct sim_mirror *mirror, guint most)
{
	const struct program *program = program_of(mirror);
	GPtrArray *names = g_ptr_array_new();

	for (guint i = mirror->units->len; i-- > 0;)
		add_unit(names, program, mirror->units->pdata[i], most);
	for (guint i = 0; i < program->entry_count && program->string_bytes; i++)
		add_unit(names, program, program->string + program->entry[i].name, most);
	for (guint i = 0; i < program->watched_count; i++)
		add_unit(names, program, program->string + program->watched[i].name, most);
	return names;
}

void sim_mirror_forget(struct sim_mirror *mirror)
{
	g_hash_table_remove_all(mirror->known);
	mirror->other = true;
}

void sim_mirror_forget_power(struct sim_mirror *mirror, const char *name)
{
	struct unit unit;

	if (find_unit(program_of(mirror), name, &unit) &&
	    g_hash_table_remove(mirror->powered, unit.name))
		mirror->other = true;
}

/* ---- reading published values ---- */

static void put_text(struct sim_mirror *mirror, struct location at, const struct iec_string *from)
{
	struct iec_string *to = (gpointer)(mirror->twin.resource.image.memory + at.where);

	to->length = MIN(from->length, to->capacity);
	memcpy(to->text, from->text, to->length);
}

void sim_mirror_value(struct sim_mirror *mirror, struct location at, bool forced, enum sim_quality quality,
		      union iec_value value)
{
	struct image *image = &mirror->twin.resource.image;
	guint32 word;

	if (at.type == IEC_NONE || at.constant)
		return;
	if (image->force_count && !forced)
		image_unforce(image, at);
	if (at.type == IEC_STRING)
		put_text(mirror, at, value.s);
	else if (forced)
		image_force(image, at, value);
	else
		image_set(image, at, value);
	word = place_word(program_of(mirror), at);
	if (quality_at(mirror, GUINT_TO_POINTER(word), G_MAXUINT64) != quality)
		g_array_append_val(mirror->marked, word);
	if (g_hash_table_insert(mirror->known, GUINT_TO_POINTER(word), GUINT_TO_POINTER((guint)quality + 1)))
		mirror->other = true;
}

static gboolean tell(gpointer data)
{
	struct sim_mirror *mirror = data;

	mirror->notify_idle = 0;
	mirror->notify(mirror->notify_data);
	return G_SOURCE_REMOVE;
}

/* The record counts scans since ladderd began; here they count since the last start. It is shown
 * only if it ends within what was published, so that no scan between them is missing. A record that
 * came before its last scans were published waits for them. */
static void join_record(struct sim_mirror *mirror)
{
	struct playback *playback = &mirror->playback;
	struct twin *twin = &playback->twin;
	struct sim_replay here = { .era = 0 };
	const guint64 first = record_file_first(mirror->file);
	const guint64 last = record_file_last(mirror->file);
	const bool good = playback_seek(playback, last) && twin->resource.scans <= last &&
			  twin->memory_size == mirror->twin.memory_size;
	const guint64 scans = mirror->plays ? last : twin->resource.scans;

	if (good && scans > sim_history_last(mirror->history))
		return;
	if (!good || !take_era(mirror, &here) ||
	    !sim_history_seek(mirror->history, &here.at, &here.replay.twin, scans)) {
		sim_replay_clear(&here);
		drop_record(mirror);
		return;
	}
	mirror->before = last - scans;
	mirror->last = scans;
	mirror->first = first > mirror->before ? first - mirror->before : 1;
	mirror->ahead_ns = twin->now_ns - here.replay.twin.now_ns;
	mirror->twin.resource.start_ns = twin->resource.start_ns -
		(playback->time_ns - here.replay.twin.now_ns);
	sim_replay_clear(&here);
	mirror->joined = true;
	mirror->notify(mirror->notify_data);
}

void sim_mirror_moment(struct sim_mirror *mirror, const struct sim_moment *moment)
{
	struct twin *twin = &mirror->twin;

	if (!mirror->begun && !mirror->plays)
		mirror->base_ns = moment->now_ns;
	/* A message of another set may be about an older scan, or none: after a restart they
	 * count from 0 again, and so does what is kept. */
	if (mirror->begun && moment->scan < sim_history_last(mirror->history) &&
	    moment->now_ns - mirror->base_ns > twin->now_ns) {
		sim_history_free(mirror->history);
		mirror->history = sim_history_new(twin, SIM_BYTES);
		mirror->era = ++eras;
		drop_record(mirror);
		forget_marks(mirror);
	} else if (mirror->begun && moment->scan < twin->scan) {
		return;
	}
	mirror->begun = true;
	twin->scan = twin->resource.scans = moment->scan;
	twin->now_ns = moment->now_ns - mirror->base_ns;
	twin->resource.state = moment->state;
	mark_changes(mirror);
	sim_history_add(mirror->history, twin);
	if (mirror->file && !mirror->joined)
		join_record(mirror);
	if (!mirror->notify_idle)
		mirror->notify_idle = g_idle_add_full(G_PRIORITY_DEFAULT, tell, mirror, NULL);
}

void sim_mirror_record(struct sim_mirror *mirror, struct record_file *file)
{
	drop_record(mirror);
	mirror->file = file;
	if (!playback_init(&mirror->playback, file)) {
		g_clear_pointer(&mirror->file, record_file_free);
		return;
	}
	join_record(mirror);
}

bool sim_mirror_computed(const struct sim_mirror *mirror, guint64 *first, guint64 *last)
{
	if (!mirror->joined)
		return false;
	*first = mirror->first;
	*last = mirror->last;
	return true;
}

bool sim_mirror_plays(const struct sim_mirror *mirror)
{
	return mirror->plays;
}

bool sim_mirror_play(struct sim_mirror *mirror, struct record_file *file)
{
	struct playback last;
	struct sim_moment moment;
	gint64 period_ns;

	if (!playback_init(&last, file))
		return false;
	playback_seek(&last, record_file_last(file));
	/* On average, in steps that a person would set. */
	period_ns = last.twin.now_ns / (gint64)MAX(record_file_last(file) -
						   record_file_first(file), 1);
	period_ns = (period_ns + 50000) / 100000 * 100000;
	twin_copy(&mirror->twin, &last.twin);
	mirror->twin.period_ns = period_ns > 0 ? period_ns : SIM_PERIOD;
	leave_texts(mirror, &mirror->twin);
	mirror->last_bad_len = last.bad_len;
	mirror->last_bad = g_memdup2(last.bad, last.bad_len);
	moment = (struct sim_moment){ mirror->twin.resource.state, record_file_last(file),
				      mirror->twin.now_ns };
	playback_free(&last);
	mirror->plays = true;
	sim_mirror_moment(mirror, &moment);
	sim_mirror_record(mirror, file);
	return true;
}

void sim_mirror_period(struct sim_mirror *mirror, gint64 ns)
{
	if (ns > 0)
		mirror->twin.period_ns = ns;
}

void sim_mirror_task(struct sim_mirror *mirror, guint task, guint64 runs, guint64 missed)
{
	if (task >= program_of(mirror)->task_count)
		return;
	mirror->twin.resource.tasks.state[task].runs = runs;
	mirror->twin.resource.tasks.state[task].overruns = missed;
}

/* ---- life ---- */

static const struct sim_source as_source = {
	.free = free_source, .take = take, .act = act, .why_not = why_not, .replay = replay,
	.span = span, .lock = lock, .unlock = unlock, .knows = knows, .quality = quality, .has_power = has_power,
	.past = past,
};

struct sim_mirror *sim_mirror_new(const struct sim_board *board, GSourceFunc notify,
				  gpointer data)
{
	struct sim_mirror *mirror = g_new0(struct sim_mirror, 1);

	mirror->source = as_source;
	mirror->board = *board;
	mirror->name = g_strdup(board->name);
	mirror->board.name = mirror->name;
	sim_program_ref(board->program);
	mirror->notify = notify;
	mirror->forces = -1;
	mirror->notify_data = data;
	if (!twin_init(&mirror->twin, board->program->program, NULL, MAX(board->period_ns, 1)))
		g_error("out of memory");
	mirror->history = sim_history_new(&mirror->twin, SIM_BYTES);
	mirror->era = ++eras;
	mirror->known = g_hash_table_new(NULL, NULL);
	mirror->marks = g_hash_table_new_full(NULL, NULL, NULL, (GDestroyNotify)g_array_unref);
	mirror->marked = g_array_new(FALSE, FALSE, sizeof(guint32));
	mirror->powered = g_hash_table_new(NULL, NULL);
	mirror->wants = g_array_new(FALSE, FALSE, sizeof(guint32));
	mirror->units = g_ptr_array_new();
	return mirror;
}

struct sim_source *sim_mirror_source(struct sim_mirror *mirror)
{
	return &mirror->source;
}
