/* SPDX-License-Identifier: MIT
 *
 * scenario_record - see scenario_record.h.
 *
 * The simulation's record has each act with the scan after which it was done. It drops the
 * oldest when it is full, so acts are copied while it runs. Acts after the newest scan are copied
 * when the next scan follows, or at the end, because more may still be added to them.
 */
#include "editor-gtk/sim/scenario_record.h"

#include "editor-gtk/kit/diag_said.h"
#include "editor-gtk/kit/i18n.h"
#include "editor-gtk/sim/live_value.h"

#include "engine/trial/session.h"
#include "engine/trial/value.h"

#include <string.h>

struct _LadderRecorder {
	GObject parent;
	LadderSim *sim;
	struct session *session;
	bool on, beginning;
	bool gone;           /* the recorded program was replaced              */
	guint64 taken;       /* acts after scans before this one are copied    */
	guint64 last;        /* last scan of the recording                     */
	char *plant;         /* file name as the scenario has it; NULL: none   */
	char *why;           /* why recording ended by itself; NULL            */
};

enum { CHANGED, ENDED, SIGNAL_COUNT };
static guint signals[SIGNAL_COUNT];

G_DEFINE_FINAL_TYPE(LadderRecorder, ladder_recorder, G_TYPE_OBJECT)

/* ---- acts ---- */

static const char *reason(const struct act *act)
{
	if (act->plant)
		return N_("the plant was changed by hand");
	switch (act->kind) {
	case ACT_FORCE: case ACT_RELEASE: case ACT_RELEASE_ALL:
		return N_("a force cannot be part of a scenario");
	case ACT_START: case ACT_WARM:
		return N_("a start cannot be part of a scenario");
	case ACT_STOP: return N_("the simulation was stopped");
	case ACT_PERIOD: return N_("the period cannot change within a scenario");
	case ACT_SPEED: return N_("the speed of the board cannot change within a scenario");
	case ACT_SET: break;
	}
	return N_("this variable has no name in a scenario");
}

struct taking {
	LadderRecorder *recorder;
	guint64 before;      /* acts after this scan or later are not copied yet */
};

static void take_act(void *context, uint64_t after, const struct act *act)
{
	struct taking *taking = context;
	LadderRecorder *recorder = taking->recorder;

	if (recorder->why || after >= taking->before)
		return;
	if (!session_act(recorder->session, after, act)) {
		recorder->why = g_strdup_printf(_("Recording ended after scan %llu: %s"),
						(unsigned long long)after,
						_(reason(act)));
		recorder->last = MIN(recorder->last, after);
	}
}

static void ended(LadderRecorder *recorder)
{
	char *why = g_steal_pointer(&recorder->why);

	recorder->on = false;
	g_signal_emit(recorder, signals[CHANGED], 0);
	g_signal_emit(recorder, signals[ENDED], 0, why);
	g_free(why);
}

/* @all: also acts after the newest scan. */
static void take(LadderRecorder *recorder, bool all)
{
	const int before = session_acts(recorder->session);
	const struct record *record = ladder_sim_lock_record(recorder->sim);
	struct taking taking = { .recorder = recorder };

	if (!record)
		return;
	recorder->last = record_last(record);
	taking.before = all ? G_MAXUINT64 : recorder->last;
	record_each_act(record, recorder->taken, take_act, &taking);
	recorder->taken = recorder->last;
	ladder_sim_unlock_record(recorder->sim);
	if (recorder->why)
		ended(recorder);
	else if (before != session_acts(recorder->session))
		g_signal_emit(recorder, signals[CHANGED], 0);
}

static void shown(LadderRecorder *recorder)
{
	if (recorder->on)
		take(recorder, false);
}

static void program_changed(LadderRecorder *recorder)
{
	recorder->gone = true;
	if (!recorder->on || recorder->beginning)
		return;
	recorder->why = g_strdup(_("Recording ended: the program was changed"));
	ended(recorder);
}

/* ---- begin, end ---- */

static void forget(LadderRecorder *recorder)
{
	g_clear_pointer(&recorder->session, session_free);
	g_clear_pointer(&recorder->why, g_free);
	g_clear_pointer(&recorder->plant, g_free);
	recorder->taken = recorder->last = 0;
}

/* The plant as a scenario names it: without folder if it is beside the program. Caller frees. */
static char *plant_name(LadderRecorder *recorder)
{
	const char *plant = ladder_sim_plant(recorder->sim);
	const char *path = ladder_document_path(ladder_sim_document(recorder->sim));
	char *folder = plant ? g_path_get_dirname(plant) : NULL;
	char *here = path ? g_path_get_dirname(path) : NULL, *name;

	name = !plant ? NULL : g_strcmp0(folder, here) == 0 ? g_path_get_basename(plant) :
	       g_strdup(plant);
	g_free(folder);
	g_free(here);
	return name;
}

bool ladder_recorder_begin(LadderRecorder *recorder, GError **error)
{
	const bool paused = ladder_sim_state(recorder->sim) == SIM_PAUSE;
	const struct twin *twin;
	bool good;

	recorder->on = false;
	recorder->beginning = true;
	good = ladder_sim_restart(recorder->sim, error);
	recorder->beginning = false;
	if (!good)
		return false;
	forget(recorder);
	twin = ladder_sim_twin(recorder->sim);
	recorder->session = session_new(&twin->resource.image, twin->period_ns);
	if (!recorder->session)
		g_error("out of memory");
	session_speed(recorder->session, twin->resource.pace.speed);
	recorder->plant = plant_name(recorder);
	session_plant(recorder->session, recorder->plant);
	recorder->on = true;
	recorder->gone = false;
	if (paused)
		ladder_sim_scan(recorder->sim, 0);
	else
		ladder_sim_run(recorder->sim);
	g_signal_emit(recorder, signals[CHANGED], 0);
	return true;
}

void ladder_recorder_end(LadderRecorder *recorder)
{
	if (!recorder->on)
		return;
	take(recorder, true);
	if (recorder->on)
		ended(recorder);
}

bool ladder_recorder_is_on(LadderRecorder *recorder)
{
	return recorder->on;
}

int ladder_recorder_acts(LadderRecorder *recorder)
{
	return recorder->session ? session_acts(recorder->session) : 0;
}

int ladder_recorder_expects(LadderRecorder *recorder)
{
	return recorder->session ? session_expects(recorder->session) : 0;
}

/* ---- expectations ---- */

/* The state right after a scan, without later acts. NULL: it is not recorded. */
static struct replay *right_after(LadderRecorder *recorder, guint64 scan)
{
	const struct record *record = ladder_sim_lock_record(recorder->sim);
	struct replay *replay = g_new0(struct replay, 1);
	const bool good = record && replay_init(replay, record) &&
			  replay_seek(replay, record, scan);

	if (record)
		ladder_sim_unlock_record(recorder->sim);
	if (good)
		return replay;
	replay_free(replay);
	g_free(replay);
	return NULL;
}

static char *said_of(const char *name, enum iec_type type, union iec_value value)
{
	char text[IEC_VALUE_TEXT];

	if (type == IEC_BOOL)
		iec_value_print(type, value, text, sizeof(text));
	else
		literal_print(type, value, text, sizeof(text));
	return g_strdup_printf("%s = %s", name, text);
}

static bool expect_at(LadderRecorder *recorder, const struct twin *shown_twin,
		      const struct twin *after, const char *name, char **said)
{
	enum diag_id why;
	const struct location at = value_find(&shown_twin->resource.image, name,
					      strlen(name), &why);
	union iec_value seen, was;

	if (at.type == IEC_NONE) {
		*said = diag_said_of(why, name);
		return false;
	}
	seen = image_get(&shown_twin->resource.image, at);
	was = image_get(&after->resource.image, at);
	if (!live_value_is_equal(at.type, seen, was)) {
		*said = g_strdup_printf(shown_twin->resource.state != STATE_RUN ?
			_("\"%s\" has its safe value in STOP: expect it in an earlier scan") :
			_("\"%s\" was set after this scan: expect it after the next scan"), name);
		return false;
	}
	if (!session_expect(recorder->session, after->scan, at, was)) {
		*said = g_strdup_printf(_("\"%s\" cannot be expected in a scenario"), name);
		return false;
	}
	*said = said_of(name, at.type, was);
	return true;
}

bool ladder_recorder_expect(LadderRecorder *recorder, const char *name, char **said)
{
	const struct twin *twin = ladder_sim_twin(recorder->sim);
	struct replay *replay;
	bool good;

	*said = NULL;
	if (!recorder->on || !twin) {
		*said = g_strdup(_("No scenario is being recorded"));
		return false;
	}
	if (twin->scan == 0) {
		*said = g_strdup(_("No scan has run yet: expect values after the first scan"));
		return false;
	}
	replay = right_after(recorder, twin->scan);
	if (!replay) {
		*said = g_strdup(_("This scan is no longer recorded"));
		return false;
	}
	good = expect_at(recorder, twin, &replay->twin, name, said);
	replay_free(replay);
	g_free(replay);
	if (good)
		g_signal_emit(recorder, signals[CHANGED], 0);
	return good;
}

static bool is_output(const struct image *image, struct location at)
{
	const enum iec_area area = at.area != AREA_NONE ? at.area :
		areas_find(&image->program->areas, at.where);

	return area == AREA_Q || area == AREA_AQ;
}

int ladder_recorder_expect_outputs(LadderRecorder *recorder)
{
	const guint64 scan = recorder->last;
	struct replay *replay = !recorder->gone && recorder->session && scan ?
		right_after(recorder, scan) : NULL;
	struct symbol_cursor cursor = { 0 };
	struct symbol symbol;
	const struct image *image;
	int count = 0;

	if (!replay)
		return 0;
	image = &replay->twin.resource.image;
	while (image_next_symbol(image, &cursor, &symbol))
		if (!(symbol.flags & SYMBOL_HIDDEN) && symbol.at.type != IEC_NONE &&
		    is_output(image, symbol.at))
			count += session_expect(recorder->session, scan, symbol.at,
						image_get(image, symbol.at));
	replay_free(replay);
	g_free(replay);
	return count;
}

char *ladder_recorder_text(LadderRecorder *recorder, const char *name)
{
	struct sink_memory memory;
	struct sink out;
	char *text = NULL;

	if (ladder_recorder_expects(recorder) == 0)
		return NULL;
	sink_memory_init(&memory);
	out = sink_to_memory(&memory);
	if (session_write(recorder->session, name, &out))
		text = g_strdup(sink_memory_text(&memory));
	sink_memory_free(&memory);
	return text;
}

/* ---- the object ---- */

static void ladder_recorder_dispose(GObject *object)
{
	LadderRecorder *recorder = LADDER_RECORDER(object);

	if (recorder->sim)
		g_signal_handlers_disconnect_by_data(recorder->sim, recorder);
	g_clear_object(&recorder->sim);
	forget(recorder);
	G_OBJECT_CLASS(ladder_recorder_parent_class)->dispose(object);
}

static void ladder_recorder_class_init(LadderRecorderClass *class)
{
	const GType type = G_TYPE_FROM_CLASS(class);

	G_OBJECT_CLASS(class)->dispose = ladder_recorder_dispose;
	signals[CHANGED] = g_signal_new("changed", type, G_SIGNAL_RUN_LAST, 0, NULL, NULL,
		NULL, G_TYPE_NONE, 0);
	signals[ENDED] = g_signal_new("ended", type, G_SIGNAL_RUN_LAST, 0, NULL, NULL, NULL,
		G_TYPE_NONE, 1, G_TYPE_STRING);
}

static void ladder_recorder_init(LadderRecorder *recorder)
{
	(void)recorder;
}

LadderRecorder *ladder_recorder_new(LadderSim *sim)
{
	LadderRecorder *recorder = g_object_new(LADDER_TYPE_RECORDER, NULL);

	recorder->sim = g_object_ref(sim);
	g_signal_connect_swapped(sim, "shown", G_CALLBACK(shown), recorder);
	g_signal_connect_swapped(sim, "program-changed", G_CALLBACK(program_changed),
				 recorder);
	return recorder;
}
