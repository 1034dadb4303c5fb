/* SPDX-License-Identifier: MIT
 *
 * sfc_sheet - a chart in pixels: the places of its boxes, texts and lines, and the part at
 * a point.
 *
 * Lanes and rows are those of the engine's layout (show/sfc_layout.h); here they get their
 * widths. Places are px at 100 %. It draws nothing and changes nothing.
 */
#ifndef EDITOR_SFC_SHEET_H
#define EDITOR_SFC_SHEET_H

#include "editor-gtk/kit/lettering.h"
#include "engine/base/diag.h"
#include "engine/model/project.h"
#include "engine/show/sfc_layout.h"

#include <graphene.h>

/* px at 100 % */
#define SFC_ROW    22     /* from one row to the next                           */
#define SFC_EDGE   28     /* around everything                                  */
#define SFC_LEAD   14     /* from a box to its actions                          */
#define SFC_BAR    11     /* half of a transition's bar                         */
#define SFC_BOUND  340    /* of a text                                          */
#define SFC_CELL   7      /* beside the text in a cell of actions                 */
#define SFC_APART  12     /* before a comment                                    */
#define SFC_ASIDE  110    /* px, most room between lanes for a comment           */

struct sfc_lane { float x, half, right; };
/* Columns of the table of actions. */
struct sfc_table { float x, what, does; };

struct sfc_sheet {
	const struct project *project; /* borrowed, as the POU                */
	const struct pou *pou;
	struct lettering *lettering;
	struct sfc_layout *layout;
	struct sfc_lane *lane;         /* by lane                             */
	struct sfc_table *table;       /* by step                             */
	char **name;                   /* by shape: the text in or at it       */
	char **times;                  /* by step                             */
	char **what, **does;           /* by use                              */
	char **comment;                /* by shape, without delimiters         */
	char **use_comment;            /* by use                              */
	GHashTable *twins;             /* places on double lines              */
	float width, height;
};

/** sfc_sheet_new - of a POU that is a chart. Owns: the caller, sfc_sheet_free(). */
struct sfc_sheet *sfc_sheet_new(const struct project *project, const struct pou *pou,
				struct lettering *lettering);
void sfc_sheet_free(struct sfc_sheet *sheet);

/** sfc_sheet_comment - where the comment of step or transition @shape begins: x, and the
 * middle of its line. */
graphene_point_t sfc_sheet_comment(const struct sfc_sheet *sheet, int shape);
/** sfc_sheet_room - px from @x to the next lane right of @lane that has something at the height @y. */
float sfc_sheet_room(const struct sfc_sheet *sheet, int lane, float x, float y);
/** sfc_sheet_y - the middle of a row. */
float sfc_sheet_y(int row);
/** sfc_sheet_box - of a shape: the box of a step, bar and text of a transition, arrow
 * and name of a jump. */
graphene_rect_t sfc_sheet_box(const struct sfc_sheet *sheet, int shape);
/** sfc_sheet_use - of an action in the table; sfc.use @use. */
graphene_rect_t sfc_sheet_use(const struct sfc_sheet *sheet, int use);
/** sfc_sheet_ends - y of a line down a lane: not into a double line. */
void sfc_sheet_ends(const struct sfc_sheet *sheet, const struct sfc_wire *wire, float *y1,
		    float *y2);

/* The part at a point. */
struct sfc_at {
	int shape;       /* of layout->shape; -1: nothing                       */
	int use;         /* of sfc.use; -1: the shape itself                    */
	bool foot;       /* at the lower edge of a step: a drag draws a link       */
};
/** sfc_sheet_at - the nearest part whose box is within @slack px. */
struct sfc_at sfc_sheet_at(const struct sfc_sheet *sheet, float x, float y, float slack);
/**
 * sfc_sheet_of_diag - the part of a diagnostic of this POU, by its line; in conditions and
 * actions by its rung
 * @checked: the chart that was checked, which has the lines; ignored if its numbers of
 *           steps, transitions or actions differ
 *
 * Fails: false: the diagnostic belongs to no part of the chart.
 */
bool sfc_sheet_of_diag(const struct sfc_sheet *sheet, const struct sfc *checked,
		       const struct diag *diag, int *shape, int *use);
/** sfc_sheet_can_part - may a page end below row @row, without cutting a box? */
bool sfc_sheet_can_part(const struct sfc_sheet *sheet, int row);

#endif
