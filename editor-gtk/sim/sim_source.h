/* SPDX-License-Identifier: MIT
 *
 * sim_source - where the values of a simulation come from: its own thread (sim_thread), or a
 * board (sim_mirror).
 *
 * sim.c asks both through the same functions, so no view knows which one it reads.
 */
#ifndef EDITOR_SIM_SOURCE_H
#define EDITOR_SIM_SOURCE_H

#include "editor-gtk/sim/sim_eras.h"

#include "engine/trial/stops.h"

/* The last refusal, and how many there were. */
enum sim_refused {
	SIM_REFUSED_PLACE, /* cannot be set or forced, or too many are forced   */
	SIM_REFUSED_STALE, /* a place of a program that does not run any more    */
};
struct sim_refusal {
	enum sim_refused why;
	guint count;
};

/* What scans caused. Counted, because not every scan is copied to the window. */
struct sim_events {
	guint ends;              /* FAULT, or STOP by the program               */
	guint failures;          /* starts in which an operation failed        */
	bool faulted;            /* the last failure was a FAULT               */
};

/* The window's copy of the thread's state. */
struct sim_view {
	struct twin twin;        /* a clone: of `program`                      */
	struct sim_program *program, *plant;
	bool running;            /* not paused                                 */
	bool fault;              /* an operation failed: outputs are safe      */
	struct sim_refusal refusal;
	struct sim_events events;
	struct stops_frame frame[LIMIT_CALLS + 1]; /* the body that stands in mid-scan, and who
				  * called it                                 */
	int frames;              /* 0: it does not stand                       */
	guint8 *outside;         /* while it stands: the areas as of the last whole scan */
};
void sim_view_clear(struct sim_view *view);

struct sim_replay {
	struct replay replay;
	struct sim_program *program, *plant; /* of its scan; NULL: of no scan     */
	guint64 era;             /* 0: of none                                 */
	gint64 edited_us;        /* of that era, at the last step              */
	guint64 at;              /* for sim_history_seek()                     */
	bool recorded;           /* a board has recorded this scan: `bad` is of it */
	guint8 *bad;             /* what was not good, as of struct playback; NULL: all was */
	gsize bad_len;
};
/** sim_replay_clear - of no scan again. */
void sim_replay_clear(struct sim_replay *replay);

struct sim_source {
	void (*free)(struct sim_source *source);
	/* Copies the newest state to @view; *other: it is of another program than before.
	 * Fails: false: there is none yet; @view is unchanged. */
	bool (*take)(struct sim_source *source, struct sim_view *view, bool *other);
	/* Does the acts between the same two scans. More than one: all are ACT_SET.
	 * @of: the program or plant that has the places; NULL: the act has no place. If it does
	 * not run any more, they are refused: other variables may be at these places. */
	void (*act)(struct sim_source *source, struct sim_program *of, const struct act *acts,
		    int count);
	/* Why a person cannot do this now; NULL: it can be tried. Translated, lives for ever. */
	const char *(*why_not)(struct sim_source *source, enum sim_wish wish);
	/* As ladder_sim_replay(). */
	bool (*replay)(struct sim_source *source, struct sim_replay *replay, guint64 scan);
	/* The scans that can be shown. */
	void (*span)(struct sim_source *source, guint64 *first, guint64 *last);
	/* The records of all programs; the thread waits until unlock(). NULL: no scan of it can
	 * be computed again. */
	const struct sim_eras *(*lock)(struct sim_source *source);
	void (*unlock)(struct sim_source *source);
	/* As ladder_sim_knows(), ladder_sim_has_power(). */
	bool (*knows)(struct sim_source *source, struct location at);
	/* As ladder_sim_replay_quality(); @replay: NULL: the newest scan, whose state is in @view. */
	enum sim_quality (*quality)(struct sim_source *source, const struct sim_view *view,
				    const struct sim_replay *replay, struct location at);
	bool (*has_power)(struct sim_source *source, const char *unit);
	/* A view needs whole scans, as ladder_sim_fetch(). */
	void (*past)(struct sim_source *source);
};
/** sim_eras_replay - as ladder_sim_replay(), in the records of @eras. */
bool sim_eras_replay(const struct sim_eras *eras, struct sim_replay *replay, guint64 scan);

#endif
