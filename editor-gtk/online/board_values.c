/* SPDX-License-Identifier: MIT
 *
 * board_values - see board_values.h.
 *
 * After a connection, a change of the board's program or a restart: find the program, begin
 * the mirror, ask the board to publish. A ping ten times a second, less often on a slow line, shows
 * how late values are.
 */
#include "editor-gtk/online/board_values.h"

#include "editor-gtk/kit/i18n.h"
#include "editor-gtk/online/board_copy.h"
#include "editor-gtk/sim/sim_mirror.h"

#include "engine/scan/place.h"

#include <string.h>

#define PERIOD_US 16000      /* of what the board publishes: a frame of the screen */
#define SLOW_US   200000     /* the same on a serial line                      */
#define VALUES_MOST 2048u    /* limits of a session, docs/online.md            */
#define UNITS_MOST  12u
#define PING_MS 100          /* between two pings, at least                     */
#define PING_MOST_US 2000000
#define PING_PART 4          /* of the time of a slow line, that pings take      */
#define LAPS_MOST 8          /* times that the record may be asked for again   */
#define LOG_MOST (16u << 20) /* bytes of it that are kept: then it is fetched anew */
#define LATE_US G_GINT64_CONSTANT(200000) /* less is not shown              */

/* A list that the board publishes. */
struct set {
	gint refs;               /* of the list, and of its request            */
	bool gone;               /* not in the list any more: @values may be gone, too */
	bool asked, refused;     /* not answered yet; the board does not publish it */
	guint16 request;
	char *unit;              /* cells of this program or instance; NULL: variables */
	GArray *places;          /* of struct location                         */
	LadderBoardValues *values;
	LadderBoardLink *link;   /* borrowed: it answers                       */
};

struct _LadderBoardValues {
	GObject parent;
	LadderSim *sim;
	LadderBoardLink *link;
	struct sim_mirror *mirror; /* NULL: nothing is shown                   */
	struct sim_program *program; /* the one to be shown                    */
	guint8 identity[32];     /* of the program of `mirror`, or of the last attempt */
	bool tried, loading;
	guint reads;             /* that ladder_board_values_took_read() has not answered */
	bool filled;             /* the values have come once                  */
	bool again;              /* views needed more while the board was asked */
	GPtrArray *sets;         /* of struct set                              */
	char *why;
	/* The board's record, as it has come; more is added. */
	GByteArray *log;         /* NULL: nothing yet                          */
	guint64 log_next, log_end; /* bytes of the board's log; end: 0: not known yet */
	bool fetching;
	bool unrecorded;         /* the board refused it                       */
	int laps;                /* how often it was begun                     */
	/* How late. */
	guint timer;
	bool pinged;             /* a ping is on its way                       */
	gint64 ping_us, pong_us; /* when the last one was sent; when the one that was
				    answered last was sent                      */
	gint64 every_us;         /* between two of them                        */
	gint64 least_us;         /* the least difference of the clocks seen    */
	gint64 delay_us;         /* of the last message                        */
};

G_DEFINE_FINAL_TYPE(LadderBoardValues, ladder_board_values, G_TYPE_OBJECT)

enum { MENDED, SIGNALS };
static guint signals[SIGNALS];

static const struct location nowhere = { .type = IEC_NONE };

static void set_why(LadderBoardValues *values, const char *why)
{
	char *before = values->why;

	values->why = g_strdup(why);
	if (*why)
		ladder_sim_mirror_refuse(values->sim, nowhere, why);
	else if (*before)
		g_signal_emit(values, signals[MENDED], 0, before);
	g_free(before);
}

/* ---- sets ---- */

static void set_unref(gpointer pointer)
{
	struct set *set = pointer;

	if (--set->refs)
		return;
	if (set->places)
		g_array_unref(set->places);
	g_free(set->unit);
	g_free(set);
}

static void unpublish(const struct set *set)
{
	struct wire_writer fields = ladder_board_link_begin(set->link);

	wire_put_u16(&fields, set->request);
	ladder_board_link_send(set->link, SERVICE_UNPUBLISH, &fields, NULL, NULL, NULL);
}

/* The board need not send this any more. @tell_board: false: it does not any more. */
static void drop_set(LadderBoardValues *values, guint index, bool tell_board)
{
	struct set *set = values->sets->pdata[index];

	set->gone = true;
	if (tell_board && !set->asked && !set->refused)
		unpublish(set);
	g_ptr_array_remove_index(values->sets, index);
}

/* There is room for it now. */
static void forget_refused(LadderBoardValues *values)
{
	for (guint i = values->sets->len; i-- > 0;)
		if (((struct set *)values->sets->pdata[i])->refused)
			drop_set(values, i, false);
}

static guint size_of(const struct set *set)
{
	return !set->unit ? set->places->len :
	       set->values->mirror ? sim_mirror_cells(set->values->mirror, set->unit) : 0;
}

static void wanted(gpointer data);

/* A refused set stays in the list, so that it is not asked for again and again. */
static void set_answered(gpointer data, struct board_answer *answer)
{
	struct set *set = data;
	LadderBoardValues *values = set->values;

	set->asked = false;
	set->request = answer->request;
	if (set->gone && answer->end == DESK_GOOD) {
		unpublish(set);
	} else if (!set->gone && answer->end != DESK_GOOD) {
		set->refused = true;
		if (!set->unit && answer->end == DESK_REFUSED)
			set_why(values, answer->text);
	} else if (!set->gone && wire_u32(&answer->body) != size_of(set)) {
		set->refused = true; /* not the cells of this program */
		unpublish(set);
	}
	if (!set->gone && values->again) {
		values->again = false;
		wanted(values);
	}
	set_unref(set);
}

static guint32 period_us(LadderBoardValues *values)
{
	const char *where = ladder_board_link_where(values->link);

	return where && g_str_has_prefix(where, "serial:") ? SLOW_US : PERIOD_US;
}

/* @unit: copied. @places: taken over. */
static void publish(LadderBoardValues *values, const char *unit, GArray *places)
{
	const struct program *program = values->program->program;
	struct set *set = g_new0(struct set, 1);
	struct wire_writer fields = ladder_board_link_begin(values->link);

	*set = (struct set){ .refs = 2, .asked = true, .unit = g_strdup(unit), .places = places,
			     .values = values, .link = values->link };
	g_ptr_array_add(values->sets, set);
	wire_put_u32(&fields, period_us(values));
	wire_put_u8(&fields, unit ? 1 : 0);
	if (unit)
		wire_put_string(&fields, unit);
	else
		wire_put_u16(&fields, (guint16)places->len);
	for (guint i = 0; places && i < places->len; i++) {
		wire_put_u8(&fields, REF_PLACE);
		wire_put_u32(&fields, place_word(program,
			g_array_index(places, struct location, i)));
	}
	ladder_board_link_send(values->link, SERVICE_PUBLISH, &fields, NULL, set_answered, set);
}

static bool same_places(const GArray *a, const GArray *b)
{
	return a->len == b->len &&
	       memcmp(a->data, b->data, a->len * sizeof(struct location)) == 0;
}

/* The old list first: both together may be more than a session can have. */
static void publish_variables(LadderBoardValues *values)
{
	bool all;
	GArray *places = sim_mirror_places(values->mirror, VALUES_MOST, &all);

	for (guint i = 0; i < values->sets->len; i++) {
		struct set *set = values->sets->pdata[i];

		if (set->unit)
			continue;
		if (same_places(set->places, places)) {
			g_array_unref(places);
			return;
		}
		drop_set(values, i, true);
		forget_refused(values);
		sim_mirror_forget(values->mirror);
		break;
	}
	if (places->len) {
		publish(values, NULL, places);
		return;
	}
	values->filled = true;
	g_array_unref(places);
}

static bool has_unit(GPtrArray *units, const char *unit)
{
	for (guint i = 0; i < units->len; i++)
		if (strcmp(units->pdata[i], unit) == 0)
			return true;
	return false;
}

static bool is_published(LadderBoardValues *values, const char *unit)
{
	for (guint i = 0; i < values->sets->len; i++) {
		const struct set *set = values->sets->pdata[i];

		if (set->unit && strcmp(set->unit, unit) == 0)
			return true;
	}
	return false;
}

static void publish_power(LadderBoardValues *values)
{
	GPtrArray *units = sim_mirror_units(values->mirror, UNITS_MOST);
	bool dropped = false;

	for (guint i = values->sets->len; i-- > 0;) {
		const struct set *set = values->sets->pdata[i];

		if (set->unit && !has_unit(units, set->unit)) {
			sim_mirror_forget_power(values->mirror, set->unit);
			drop_set(values, i, true);
			dropped = true;
		}
	}
	if (dropped)
		forget_refused(values);
	for (guint i = 0; i < units->len; i++)
		if (!is_published(values, units->pdata[i]))
			publish(values, units->pdata[i], NULL);
	g_ptr_array_unref(units);
}

static bool is_asking(LadderBoardValues *values)
{
	for (guint i = 0; i < values->sets->len; i++)
		if (((struct set *)values->sets->pdata[i])->asked)
			return true;
	return false;
}

/* One after the other: what a set is answered with must be known before it can be exchanged for
 * another one, and a session has room for one. */
static void wanted(gpointer data)
{
	LadderBoardValues *values = data;

	if (!values->mirror || ladder_board_link_state(values->link) != LINK_CONNECTED)
		return;
	values->again = is_asking(values);
	if (values->again)
		return;
	publish_variables(values);
	publish_power(values);
}

/* ---- acts ---- */

/* A request for an act; `values` is weak. */
struct acted { LadderBoardValues *values; struct location at; };

static struct acted *acted_new(LadderBoardValues *values, struct location at)
{
	struct acted *acted = g_new(struct acted, 1);

	*acted = (struct acted){ values, at };
	g_object_add_weak_pointer(G_OBJECT(values), (gpointer *)&acted->values);
	return acted;
}

static void act_answered(gpointer data, struct board_answer *answer)
{
	struct acted *acted = data;
	LadderBoardValues *values = acted->values;

	if (values) {
		g_object_remove_weak_pointer(G_OBJECT(values), (gpointer *)&acted->values);
		if (answer->end == DESK_GOOD)
			ladder_board_link_look(values->link); /* how many are forced now */
		else if (*answer->text)
			ladder_sim_mirror_refuse(values->sim, acted->at, answer->text);
	}
	g_free(acted);
}

/* The place is of the program that is shown: the board refuses it if another one runs. */
static void change(LadderBoardValues *values, enum service service, const struct act *acts,
		   int count)
{
	const struct program *program = values->program->program;
	struct wire_writer fields = ladder_board_link_begin(values->link);
	struct expect expect = { .mode = EXPECT_ANY };

	memcpy(expect.program, values->identity, sizeof(expect.program));
	wire_put_expect(&fields, &expect);
	wire_put_u16(&fields, acts->kind == ACT_RELEASE_ALL ? 0 : (guint16)count);
	for (int i = 0; i < count && acts->kind != ACT_RELEASE_ALL; i++) {
		wire_put_u8(&fields, REF_PLACE);
		wire_put_u32(&fields, place_word(program, acts[i].at));
		if (service == SERVICE_UNFORCE)
			continue;
		wire_put_u8(&fields, (guint8)acts[i].at.type);
		wire_put_value(&fields, acts[i].at.type, acts[i].value);
	}
	ladder_board_link_send(values->link, service, &fields, NULL, act_answered,
			       acted_new(values, acts->kind == ACT_RELEASE_ALL ? nowhere : acts->at));
}

static void mode(LadderBoardValues *values, enum mode_wish wish)
{
	const struct board_status *status = ladder_board_link_status(values->link);
	struct expect expect = ladder_board_link_expect(values->link);

	expect.mode = EXPECT_ANY; /* the views may know more than the last status */
	if (status && status->mode == STATE_FAULT && wish != MODE_STOP)
		wish = MODE_RESET;
	ladder_board_link_mode(values->link, &expect, wish, NULL, act_answered,
			       acted_new(values, nowhere));
}

static void act(gpointer data, const struct act *acts, int count)
{
	LadderBoardValues *values = data;

	switch (acts->kind) {
	case ACT_SET: change(values, SERVICE_WRITE, acts, count); break;
	case ACT_FORCE: change(values, SERVICE_FORCE, acts, count); break;
	case ACT_RELEASE: /* fall through */
	case ACT_RELEASE_ALL: change(values, SERVICE_UNFORCE, acts, count); break;
	case ACT_START: mode(values, MODE_COLD); break;
	case ACT_WARM: mode(values, MODE_WARM); break;
	case ACT_STOP: mode(values, MODE_STOP); break;
	case ACT_PERIOD: case ACT_SPEED: break; /* why_not() */
	}
}

static const char *why_not(gpointer data, enum sim_wish wish)
{
	LadderBoardValues *values = data;

	switch (wish) {
	case SIM_WISH_RUN: return ladder_board_link_needs(values->link, ROLE_ENG);
	case SIM_WISH_TIME:
		return _("A board cannot pause or scan step by step: that is for the simulation");
	case SIM_WISH_RESTART:
		return _("A board is connected. Disconnect it to simulate");
	case SIM_WISH_SET: return ladder_board_link_why_not(values->link, SERVICE_WRITE);
	case SIM_WISH_FORCE: return ladder_board_link_why_not(values->link, SERVICE_FORCE);
	}
	return NULL;
}

/* ---- the board's record ---- */

/* The log with the program that is here already: scans of other programs are left out. */
static struct record_file *open_log(LadderBoardValues *values)
{
	const struct program *program = values->program->program;
	struct record_parts *parts = g_new0(struct record_parts, 1);
	struct record_file *file = NULL;
	struct sink_memory memory;
	struct sink sink;
	enum diag_id why;
	size_t where;

	parts->board = ladder_board_link_board(values->link);
	parts->log = values->log->data;
	parts->len = values->log->len;
	parts->program_count = 1;
	memcpy(parts->program[0].identity, values->identity, sizeof(values->identity));
	parts->program[0].image = program->base;
	parts->program[0].len = program->header->size;
	sink_memory_init(&memory);
	sink = sink_to_memory(&memory);
	if (record_write(parts, &sink) && !memory.failed)
		file = record_file_open(memory.text, memory.len, &why, &where);
	sink_memory_free(&memory);
	g_free(parts);
	return file;
}

static void ask_log(LadderBoardValues *values);

static void end_log(LadderBoardValues *values)
{
	values->fetching = false;
	g_clear_pointer(&values->log, g_byte_array_unref);
}

/* Begins anew where the board begins, at first and if it has dropped what was wanted. */
static void log_came(gpointer data, struct board_answer *answer)
{
	LadderBoardValues *values = data;
	struct wire_reader *in = &answer->body;
	struct record_file *file;
	guint64 end, at;
	gsize len;

	if (!values->fetching)
		return;
	values->unrecorded = answer->end == DESK_REFUSED;
	wire_u64(in); /* the oldest byte */
	end = wire_u64(in);
	at = wire_u64(in);
	len = wire_left(in);
	if (at != values->log_next) {
		g_byte_array_set_size(values->log, 0);
		values->log_end = 0;
		values->laps++;
	}
	if (!values->log_end)
		values->log_end = end;
	if (answer->end != DESK_GOOD || in->failed || !values->mirror ||
	    values->laps > LAPS_MOST || values->log->len + len > RECORD_MOST) {
		end_log(values);
		return;
	}
	if (len)
		g_byte_array_append(values->log, wire_bytes(in, len), (guint)len);
	values->log_next = at + len;
	if (len && values->log_next < values->log_end) {
		ask_log(values);
		return;
	}
	values->fetching = false;
	file = open_log(values);
	if (file)
		sim_mirror_record(values->mirror, file);
}

static void ask_log(LadderBoardValues *values)
{
	struct wire_writer fields = ladder_board_link_begin(values->link);

	wire_put_u8(&fields, 0);
	wire_put_u64(&fields, values->log_next);
	ladder_board_link_send(values->link, SERVICE_RECORD, &fields, values, log_came, values);
}

/* A board without a record refuses: then what was published is shown. */
static void past(gpointer data)
{
	LadderBoardValues *values = data;

	if (values->fetching || values->unrecorded || !values->mirror)
		return;
	if (values->log && values->log->len > LOG_MOST)
		end_log(values);
	if (!values->log) {
		values->log = g_byte_array_new();
		values->log_next = 0;
	}
	values->log_end = 0;
	values->laps = 0;
	values->fetching = true;
	ask_log(values);
}

/* ---- begin and end ---- */

static void end(LadderBoardValues *values)
{
	while (values->sets->len)
		drop_set(values, values->sets->len - 1, false);
	values->filled = values->again = values->unrecorded = false;
	end_log(values);
	if (values->mirror) {
		values->mirror = NULL;
		ladder_sim_end(values->sim);
	}
	g_clear_pointer(&values->program, sim_program_unref);
	g_clear_handle_id(&values->timer, g_source_remove);
}

static gboolean ping_due(gpointer data);

static void begin(LadderBoardValues *values, struct sim_program *program)
{
	const struct board_status *status = ladder_board_link_status(values->link);
	const struct sim_board board = {
		.name = ladder_board_link_board(values->link), .program = program,
		.period_ns = status ? status->period_ns : 0,
		.act = act, .why_not = why_not, .wanted = wanted, .past = past,
		.data = values,
	};

	values->program = sim_program_ref(program);
	values->mirror = ladder_sim_mirror_begin(values->sim, &board);
	values->least_us = G_MAXINT64;
	values->delay_us = 0;
	values->pinged = false;
	values->pong_us = g_get_monotonic_time();
	values->ping_us = 0;
	values->every_us = PING_MS * 1000;
	values->timer = g_timeout_add(PING_MS, ping_due, values);
	set_why(values, "");
	if (status)
		ladder_sim_mirror_forces(values->sim, status->forces);
	wanted(values);
}

/* ---- which program ---- */

static bool runs(LadderBoardValues *values, const struct sim_program *program)
{
	guint8 identity[32];

	code_identity(program->program, identity);
	return memcmp(identity, values->identity, sizeof(identity)) == 0;
}

static struct sim_program *read_copy(const struct board_copy *copy, GError **error)
{
	struct ladder *reader = ladder_new();
	struct sim_program *program;
	gsize len = 0;
	const void *image;

	if (!reader)
		g_error("out of memory");
	board_copy_give_files(copy, reader);
	program = sim_program_read(reader, g_intern_string("-"), copy->text, strlen(copy->text),
				   error);
	image = copy->image ? g_bytes_get_data(copy->image, &len) : NULL;
	if (program && image)
		sim_program_open_image(program, image, len);
	return program;
}

/* The board may have got another program while this one came. */
static bool is_newest(LadderBoardValues *values)
{
	const struct board_status *status = ladder_board_link_status(values->link);

	return status && memcmp(values->identity, status->program, sizeof(values->identity)) == 0;
}

bool ladder_board_values_took_read(LadderBoardValues *values)
{
	if (!values->reads)
		return false;
	values->reads--;
	return true;
}

void ladder_board_values_again(LadderBoardValues *values)
{
	if (!values->mirror)
		values->tried = false;
}

static void copied(gpointer data, struct board_copy *copy, const char *why, bool locked)
{
	LadderBoardValues *values = data;
	struct sim_program *program = NULL;
	GError *error = NULL;
	char *text;

	(void)locked;
	values->loading = false;
	if (!copy && values->reads)
		values->reads--; /* the board has logged nothing */
	if (ladder_board_link_state(values->link) == LINK_CONNECTED && copy && copy->text)
		program = read_copy(copy, &error);
	if (program && runs(values, program) && is_newest(values)) {
		begin(values, program);
	} else if (ladder_board_link_state(values->link) == LINK_CONNECTED) {
		text = g_strdup_printf(_("Values of the board are not shown: %s"),
			error ? error->message : !copy ? why : !copy->text ?
			_("it runs another program than this one and has no sources of it") :
			is_newest(values) ? _("its sources are not those of its program") :
			_("its program has changed"));
		set_why(values, text);
		g_free(text);
		if (!is_newest(values)) /* looks again at the next status */
			values->tried = false;
	}
	g_clear_error(&error);
	sim_program_unref(program);
	board_copy_free(copy);
}

/* The program of the document, if that is what the board runs: it is here already. */
static bool begin_own(LadderBoardValues *values)
{
	struct sim_program *program = ladder_sim_build(values->sim, NULL);
	const bool same = program && runs(values, program);

	if (same)
		begin(values, program);
	sim_program_unref(program);
	return same;
}

static void find_program(LadderBoardValues *values, const struct board_status *status)
{
	char *text;

	memcpy(values->identity, status->program, sizeof(values->identity));
	values->tried = true;
	if (ladder_board_link_role(values->link) < ROLE_VIEW)
		return;
	if (!status_has_program(status)) {
		set_why(values, _("The board has no program."));
		return;
	}
	if (begin_own(values))
		return;
	if (!ladder_board_link_may(values->link, SERVICE_UPLOAD)) {
		text = g_strdup_printf(_("Values of the board are not shown: it runs another program "
			"than this one. %s"), ladder_board_link_why_not(values->link, SERVICE_UPLOAD));
		set_why(values, text);
		g_free(text);
		return;
	}
	values->loading = true;
	values->reads++;
	board_upload(values->link, G_OBJECT(values), copied, values);
}

/* ---- what the link tells ---- */

static void status_came(LadderBoardValues *values)
{
	const struct board_status *status = ladder_board_link_status(values->link);

	if (!status)
		return;
	if (!values->mirror) {
		if (!values->loading && (!values->tried ||
		    memcmp(values->identity, status->program, sizeof(values->identity)) != 0))
			find_program(values, status);
		return;
	}
	sim_mirror_period(values->mirror, status->period_ns);
	ladder_sim_mirror_forces(values->sim, status->forces);
	for (guint i = 0; i < status->task_count; i++)
		sim_mirror_task(values->mirror, i, status->task[i].runs, status->task[i].overruns);
}

static void program_changed(LadderBoardValues *values)
{
	end(values);
	values->tried = false;
}

static void state_changed(LadderBoardValues *values)
{
	const enum link_state state = ladder_board_link_state(values->link);

	if (state == LINK_CONNECTED)
		return;
	program_changed(values);
	values->loading = false;
	if (state == LINK_OFF)
		set_why(values, "");
}

static struct set *set_of(LadderBoardValues *values, guint16 request)
{
	for (guint i = 0; i < values->sets->len; i++) {
		struct set *set = values->sets->pdata[i];

		if (set->request == request && !set->asked && !set->refused)
			return set;
	}
	return NULL;
}

static void take_values(LadderBoardValues *values, const struct set *set,
			struct wire_reader *in)
{
	const guint count = wire_u16(in);
	struct iec_text room;

	for (guint i = 0; i < count; i++) {
		const guint index = wire_u16(in);
		const guint8 flags = wire_u8(in);
		struct location at;
		union iec_value value;

		if (in->failed || index >= set->places->len)
			return;
		at = g_array_index(set->places, struct location, index);
		value = wire_value(in, at.type, &room);
		if (in->failed)
			return;
		sim_mirror_value(values->mirror, at, flags & VALUE_FORCED, flags & VALUE_FAULT ? SIM_VALUE_FAULT :
				 flags & VALUE_STALE ? SIM_STALE : SIM_GOOD, value);
	}
	values->filled = true;
}

static void take_power(LadderBoardValues *values, const struct set *set,
		       struct wire_reader *in)
{
	const gsize size = (sim_mirror_cells(values->mirror, set->unit) + 3) / 4;
	const guint8 *bits = wire_bytes(in, size);

	if (bits)
		sim_mirror_power(values->mirror, set->unit, bits);
}

/* The clocks of board and desk differ; the least difference that was seen is a message that came
 * at once. */
static void notice_delay(LadderBoardValues *values, gint64 now_ns)
{
	const gint64 difference = g_get_monotonic_time() - now_ns / 1000;

	values->least_us = MIN(values->least_us, difference);
	values->delay_us = difference - values->least_us;
}

static void told(LadderBoardLink *link, gpointer pointer, LadderBoardValues *values)
{
	struct frame frame = *(const struct frame *)pointer;
	struct wire_reader *in = &frame.body;
	const struct set *set = frame.service == SERVICE_PUBLISH ?
				set_of(values, frame.request) : NULL;
	struct sim_moment moment;

	(void)link;
	if (!set || !values->mirror)
		return;
	wire_u8(in);
	moment.state = (enum resource_state)wire_u8(in);
	moment.scan = wire_u64(in);
	moment.now_ns = wire_i64(in);
	wire_u32(in);
	if (in->failed || moment.state > STATE_FAULT)
		return;
	if (set->unit)
		take_power(values, set, in);
	else
		take_values(values, set, in);
	notice_delay(values, moment.now_ns);
	if (values->filled)
		sim_mirror_moment(values->mirror, &moment);
}

/* ---- how late ---- */

static void show_late(LadderBoardValues *values)
{
	const gint64 silent_us = g_get_monotonic_time() - values->pong_us - values->every_us;
	const gint64 late_us = MAX(values->delay_us, silent_us);

	/* In steps, so that the text can be read. */
	ladder_sim_mirror_late(values->sim, late_us < LATE_US ? 0 :
			       late_us / 100000 * 100000 * 1000);
}

/* A read of no variable: the state of the board, even when no value changes. */
static void pong(gpointer data, struct board_answer *answer)
{
	LadderBoardValues *values = data;
	struct sim_moment moment;

	values->pinged = false;
	if (answer->end != DESK_GOOD || !values->mirror)
		return;
	moment.state = (enum resource_state)wire_u8(&answer->body);
	moment.scan = wire_u64(&answer->body);
	moment.now_ns = wire_i64(&answer->body);
	if (answer->body.failed || moment.state > STATE_FAULT)
		return;
	values->pong_us = values->ping_us;
	values->every_us = CLAMP((g_get_monotonic_time() - values->ping_us) * PING_PART,
				 PING_MS * 1000, PING_MOST_US);
	values->delay_us = 0;
	show_late(values);
	if (values->filled)
		sim_mirror_moment(values->mirror, &moment);
}

static gboolean ping_due(gpointer data)
{
	LadderBoardValues *values = data;
	struct wire_writer fields;

	show_late(values);
	if (values->pinged ||
	    g_get_monotonic_time() - values->ping_us < values->every_us - PING_MS * 500)
		return G_SOURCE_CONTINUE;
	values->pinged = true;
	values->ping_us = g_get_monotonic_time();
	fields = ladder_board_link_begin(values->link);
	wire_put_u16(&fields, 0);
	ladder_board_link_send(values->link, SERVICE_READ, &fields, values, pong, values);
	return G_SOURCE_CONTINUE;
}

/* ---- the object ---- */

static void ladder_board_values_dispose(GObject *object)
{
	LadderBoardValues *values = LADDER_BOARD_VALUES(object);

	if (values->link)
		g_signal_handlers_disconnect_by_data(values->link, values);
	if (values->sim)
		end(values);
	g_clear_object(&values->link);
	g_clear_object(&values->sim);
	G_OBJECT_CLASS(ladder_board_values_parent_class)->dispose(object);
}

static void ladder_board_values_finalize(GObject *object)
{
	LadderBoardValues *values = LADDER_BOARD_VALUES(object);

	g_ptr_array_unref(values->sets);
	g_free(values->why);
	G_OBJECT_CLASS(ladder_board_values_parent_class)->finalize(object);
}

static void ladder_board_values_class_init(LadderBoardValuesClass *class)
{
	G_OBJECT_CLASS(class)->dispose = ladder_board_values_dispose;
	G_OBJECT_CLASS(class)->finalize = ladder_board_values_finalize;
	signals[MENDED] = g_signal_new("mended", G_TYPE_FROM_CLASS(class), G_SIGNAL_RUN_LAST, 0,
				       NULL, NULL, NULL, G_TYPE_NONE, 1, G_TYPE_STRING);
}

static void ladder_board_values_init(LadderBoardValues *values)
{
	values->sets = g_ptr_array_new_with_free_func(set_unref);
	values->why = g_strdup("");
}

LadderBoardValues *ladder_board_values_new(LadderSim *sim, LadderBoardLink *link)
{
	LadderBoardValues *values = g_object_new(LADDER_TYPE_BOARD_VALUES, NULL);

	values->sim = g_object_ref(sim);
	values->link = g_object_ref(link);
	g_signal_connect_swapped(link, "state-changed", G_CALLBACK(state_changed), values);
	g_signal_connect_swapped(link, "status", G_CALLBACK(status_came), values);
	g_signal_connect_swapped(link, "program-changed", G_CALLBACK(program_changed), values);
	g_signal_connect(link, "told", G_CALLBACK(told), values);
	return values;
}
