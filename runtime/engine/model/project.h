/* SPDX-License-Identifier: MIT
 *
 * project - what a rung file says: variables, POUs, rungs.
 *
 * Owns everything in it through one arena, but for the rungs, which an editor
 * exchanges one by one (rung_free). It holds what was written, right or wrong.
 */
#ifndef MODEL_PROJECT_H
#define MODEL_PROJECT_H

#include "engine/base/areas.h"
#include "engine/model/sfc.h"
#include "engine/model/config.h"
#include "engine/model/il.h"
#include "engine/model/rung.h"
#include "engine/model/vars.h"
#include "engine/model/words.h"

struct advice;
enum pou_language { LANGUAGE_LD, LANGUAGE_IL, LANGUAGE_SFC };
enum pou_kind { POU_PROGRAM, POU_FUNCTION, POU_BLOCK, POU_SUBROUTINE };

struct pou {
	uint32_t name;          /* string id                                   */
	enum pou_language language;
	enum pou_kind kind;
	enum word word;         /* of a function or block; WORD_COUNT: none    */
	enum word temp_word;    /* of its VAR_TEMP as one; WORD_COUNT: none    */
	int edges;              /* cells with a memory: in each instance       */
	uint32_t edge_offset;   /* in an instance: where those lie             */
	struct var_table vars;  /* locals                                      */
	struct rung **rung;     /* of LD, SFC; malloc'ed vector of malloc'ed rungs */
	int rung_count;
	struct il il;           /* of IL, SFC                                  */
	struct sfc *sfc;        /* of SFC; NULL: another language              */
	uint32_t comment;       /* above it                                    */
	uint32_t tail;          /* comments before its END_PROGRAM             */
	const char *file;       /* it stands in; borrowed from the arena       */
	int line;
	uint8_t included;       /* 1: of a file named by INCLUDE               */
};

/* TYPE name : STRUCT … END_STRUCT; END_TYPE */
struct structure {
	uint32_t name;          /* string id                                   */
	enum word word;
	struct var_table vars;  /* its members                                 */
	uint32_t comment;       /* behind its END_STRUCT                       */
	const char *file;
	int line;
};

/* What stood where in the file, so that writing keeps the order. */
enum part_kind { PART_VARS, PART_POU, PART_VIEW, PART_INCLUDE,
		 PART_CONFIG, PART_USES, PART_TYPES };
struct part {
	enum part_kind kind;
	int index;              /* var block of globals, POU, first structure  */
	int count;              /* structures                                  */
	uint32_t text;          /* string id: VIEW … END_VIEW whole; file name */
	uint32_t comment;       /* above it                                    */
	uint8_t included;       /* came from another file: not written         */
};

struct project {
	struct arena arena;
	const struct advice *advice; /* of who reads its messages; NULL: none    */
	struct names names;
	struct word_table words; /* of the catalogue and its own              */
	const char *file;
	uint32_t title;         /* PROJECT "…"                                 */
	uint32_t head;          /* comments above PROJECT or the first part    */
	uint32_t tail;          /* comments at the end                         */
	struct var_table globals;
	struct config *config;  /* NULL: none                                  */
	struct pou *pou;
	int pou_count;
	struct structure *structure;
	int structure_count;
	const char **used;      /* paths of files named by USES                */
	int used_count;
	struct part *part;
	int part_count;
};

/** project_new - an empty project.
 * Owns: the caller, project_free().   Fails: NULL when memory is out. */
struct project *project_new(const char *file);
void project_free(struct project *project);

/* Rungs of a POU: @at 0-based. The project takes over the rung it is given. */
bool project_add_rung(struct pou *pou, int at, struct rung *rung);
/** project_take_rung - removes it; the caller owns what is returned. */
struct rung *project_take_rung(struct pou *pou, int at);
/** project_areas - how large the areas of this project are: what its configuration says,
 * or what is usual.   Fails: false if they are too large together. */
bool project_areas(const struct project *project, struct areas *out);
/** project_has - is one address inside them? AREA_NONE always. Who asks for many asks
 * areas_have(). */
bool project_has(const struct project *project, struct iec_addr addr);
/** pou_has_frame - is it called with parameters, on variables that lie elsewhere: a
 * FUNCTION, a FUNCTION_BLOCK? */
bool pou_has_frame(const struct pou *pou);
/** project_view - VIEW … END_VIEW of the file itself, whole; "" if it has none. */
const char *project_view(const struct project *project);
/** project_view_is_last - is it the last part? */
bool project_view_is_last(const struct project *project);
/** project_set_view - that text takes its place, behind all parts if there was none; "":
 * there is none any more. Borrows nothing.   Fails: false: no memory, nothing changed. */
bool project_set_view(struct project *project, const char *text);
/** pou_word - PROGRAM, FUNCTION, FUNCTION_BLOCK, SUBROUTINE. Lives for ever. */
const char *pou_word(enum pou_kind kind);
/** pou_language_word - LD, IL, SFC. Lives for ever. */
const char *pou_language_word(enum pou_language language);
/** project_find_pou - index of the POU with this name, in any case; -1: none. @len: bytes. */
int project_find_pou(const struct project *project, const char *name, size_t len);
/** project_text - the string of an id. */
const char *project_text(const struct project *project, uint32_t id);
#endif
