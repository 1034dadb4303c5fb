/* SPDX-License-Identifier: MIT
 *
 * project - the contents of a rung file: variables, POUs, rungs.
 *
 * One arena owns everything except the rungs, which an editor replaces singly
 * (rung_free). Texts with errors are kept as written.
 */
#ifndef MODEL_PROJECT_H
#define MODEL_PROJECT_H

#include "engine/base/areas.h"
#include "engine/base/sink.h"
#include "engine/model/sfc.h"
#include "engine/model/il.h"
#include "engine/model/property.h"
#include "engine/model/rung.h"
#include "engine/model/vars.h"
#include "engine/model/words.h"

/* A CONFIGURATION as it was written, line by line (IEC 61131-3, 2.7 and tables 49 and
 * 50). check/ resolves the names, scan/ decides when a task runs. */
enum config_kind { CONFIG_VARS, CONFIG_AREA, CONFIG_TASK, CONFIG_PROGRAM, CONFIG_ACCESS,
		   CONFIG_LOCATED, CONFIG_RESOURCE };

struct st_item;

/* One line; members of other kinds are 0. */
struct config_entry {
	enum config_kind kind;
	bool inside;          /* of a RESOURCE                                */
	uint32_t name;        /* TASK, PROGRAM, RESOURCE: string id           */
	uint32_t pou, task;   /* PROGRAM: string ids; task 0: none. RESOURCE, each behind the first one, whose
				 entries follow: its kind behind ON, comments behind END_RESOURCE */
	uint32_t own_name, own_task; /* as written, if another RESOURCE has the name, too: then name and task
				 are Resource_Name; 0: name and task are as written */
	struct block_task { uint32_t name, task, own_task; } *called; /* PROGRAM: `Pump WITH Fast`: string ids of a
				 block of the program and the task that calls it; own_task as below */
	int calls;
	struct st_item *value; /* PROGRAM: Input := value; or, `behind`, place := Output */
	int values;
	uint32_t single;      /* TASK: string id of an operand; 0: none       */
	int64_t interval_ns, watchdog_ns; /* TASK; 0: none                    */
	uint32_t interval, watchdog;      /* string ids, as written           */
	uint32_t priority;    /* TASK: 0 is the highest                       */
	enum iec_area area;   /* AREA                                         */
	uint32_t bytes;       /* AREA: its size                               */
	int block;            /* VARS: index of a block of the globals; ACCESS: of
				 project.access_block; LOCATED: of project.located */
	uint32_t comment;     /* its comment                                  */
	int line;
};

struct config {
	uint32_t name;
	uint32_t comment;     /* the comment of its first line                */
	bool has_resource;        /* the first one                            */
	uint32_t resource, on; /* string ids; on 0: not written               */
	uint32_t resource_comment;
	uint32_t resource_inside; /* comments in a RESOURCE without entries   */
	uint32_t resource_behind; /* behind END_RESOURCE                      */
	int resource_at;          /* entries above RESOURCE                   */
	struct config_entry *entry;
	int count;
	const char *file;     /* it stands in; borrowed from the arena        */
	int line;
};

struct advice;
struct st;
struct fbd;
enum pou_language { LANGUAGE_LD, LANGUAGE_IL, LANGUAGE_SFC, LANGUAGE_ST, LANGUAGE_FBD };
enum pou_kind { POU_PROGRAM, POU_FUNCTION, POU_BLOCK, POU_SUBROUTINE,
		POU_ACTION }; /* its name is that of its owner, a dot and its own */
#define POU_KINDS (POU_ACTION + 1)

/* The statements of an EXECUTE box. Its cell has their canonical text as `args`, which
 * text_take_boxes() and text_give_boxes() keep the same. */
struct boxed {
	int rung, row, col;     /* 0-based: its cell                           */
	uint32_t name;          /* string id; 0: none                          */
	uint32_t text;          /* string id: canonical, as of the cell        */
	int first, count;       /* of pou->st->item                            */
	int line;               /* of the word EXECUTE above them in the file  */
};

struct pou {
	uint32_t name;          /* string id                                   */
	enum pou_language language;
	bool no_result;         /* of a function: its heading has no type; the result is a BOOL
				 * that nobody reads                           */
	int copy_of;            /* while a project is built: of that POU, + 1, with bounds; 0: of none */
	bool unsaid;            /* its first line has no language: the body shows it */
	enum pou_kind kind;
	enum word word;         /* of a function or block; WORD_COUNT: none    */
	enum word temp_word;    /* row of its VAR_TEMP; WORD_COUNT: none       */
	int edges;              /* cells with a memory: in each instance       */
	struct var_table vars;  /* locals                                      */
	struct var_table external; /* VAR_EXTERNAL: the globals that it uses, if it tells them */
	struct rung **rung;     /* of LD, SFC; malloc'ed vector of malloc'ed rungs */
	int rung_count;
	struct il il;           /* of IL, SFC                                  */
	struct sfc *sfc;        /* of SFC; NULL: another language              */
	struct fbd *fbd;        /* of FBD (model/fbd.h); NULL: another language */
	struct st *st;          /* of ST (model/st.h), of FBD the lines of all networks; else all statements of actions and EXECUTE
				 * boxes; NULL: there are none                 */
	struct boxed *boxed;    /* of EXECUTE boxes, in the order of their cells */
	int boxed_count;
	uint32_t comment;       /* above it                                    */
	uint32_t uses;          /* string id: USING lines behind its heading, as they are written; 0: none */
	uint32_t tail;          /* comments before its END_PROGRAM             */
	const char *file;       /* file it is in; borrowed from the arena      */
	int line;
	uint8_t included;       /* 1: of a file named by INCLUDE               */
};

/* Whether its members share their bytes, and how it is written: UNION, STRUCT OVERLAP. */
enum overlap { OVERLAP_NONE, OVERLAP_UNION, OVERLAP_STRUCT };

/* TYPE name : STRUCT … END_STRUCT; END_TYPE */
struct structure {
	uint32_t name;          /* string id; 0: STRUCT … END_STRUCT in a declaration */
	enum word word;
	enum overlap overlap : 8;
	struct var_table vars;  /* its members                                 */
	uint32_t comment;       /* comments before its END_STRUCT              */
	uint32_t text;          /* string id: all of it, if it has no name: two alike are one type */
	const char *file;
	int line;
};

/* A value of an enumeration (IEC 61131-3, 2.3.3.1). */
struct enum_value {
	uint32_t name, fold;    /* string ids                                  */
	uint32_t text;          /* string id: the number as written; 0: one more than before */
	int64_t number;
	int enumeration;        /* index in the project                        */
	struct var_written *written; /* it needs an expression: check/settle.c; NULL: a number */
};

/* ( Red, Green := 5, Blue ) */
struct enumeration {
	int first, count;       /* of project.enum_value                       */
	uint32_t name;          /* string id of its type; 0: of a variable     */
	enum iec_type type;
	bool based;             /* its type is in the file: INT ( … )          */
};

/* TYPE name : an enumeration, a subrange, or another name of a type. What is behind the colon is
 * kept like the declaration of a variable. */
struct named_type {
	uint32_t name, fold;    /* string ids                                  */
	struct var_table like;  /* one variable                                */
	int part;               /* it stands in this part of the file,         */
	int before;             /* above this structure                        */
	const char *file;
	int line;
	uint8_t state;          /* while it is resolved                        */
};

/* One line of VAR_ACCESS (IEC 61131-3, 2.7.1): operators and gateways may read or write this
 * variable under this name. check/access.h finds the variable. */
struct access {
	struct var var;         /* name, type, comment and line; no address, no value */
	uint32_t path;          /* string id: as written, such as Main.Delay.ET */
	bool writes;            /* READ_WRITE                                  */
};

/* VAR_ACCESS … END_VAR */
struct access_block {
	uint32_t comment;       /* above it                                    */
	int first, count;       /* of project.access                           */
	int pou;                /* it stands in this program, + 1; 0: in none  */
	const char *file;       /* it stands in; borrowed from the arena       */
	int line;
	bool included;          /* came from another file                      */
};

/* The order of the parts in the file, kept for writing. */
enum part_kind { PART_VARS, PART_POU, PART_VIEW, PART_INCLUDE,
		 PART_CONFIG, PART_USES, PART_TYPES, PART_ACCESS,
		 PART_SPACE };
struct part {
	enum part_kind kind;
	int index;              /* var block of globals, POU, first structure, access block */
	int count;              /* structures                                  */
	uint32_t text;          /* string id: text from VIEW to END_VIEW; file name; NAMESPACE …,
				 * END_NAMESPACE, USING …; as it is written      */
	uint32_t comment;       /* above it                                    */
	uint8_t included;       /* came from another file: not written         */
	uint16_t source;        /* the file that it, or what includes it, stands in */
};

/* A file of the project, without those that it names. */
struct source_file {
	const char *name;       /* borrowed from the arena                     */
	uint32_t tail;          /* comments at its end, if it is not the first */
	bool plain;             /* IEC text without the first line of a rung file */
	bool read;              /* false: a file of another kind; reported      */
	bool foreign;           /* another tool's file: nothing here writes it */
};

struct project {
	struct arena arena;
	const struct advice *advice; /* for messages to people; NULL: none       */
	struct names names;
	struct word_table words; /* words of the catalogue and of the project */
	const char *file;
	uint32_t title;         /* PROJECT "…"                                 */
	uint32_t property[PROPERTY_COUNT]; /* string ids; 0: not given         */
	uint32_t head;          /* comments above PROJECT or the first part    */
	uint32_t tail;          /* comments at the end of the first file       */
	struct var_table globals;
	struct var_table located; /* lines of VAR_CONFIG; a name is a path, as P1.Speed */
	struct var *unlocated;  /* by line: the variable as its program declares it */
	struct access *access;  /* lines of all VAR_ACCESS                     */
	int access_count;
	struct access_block *access_block;
	int access_block_count;
	struct config *config;  /* NULL: none                                  */
	struct pou *pou;
	int pou_count;
	struct structure *structure;
	int structure_count;
	struct named_type *named;
	int named_count;
	struct enumeration *enumeration;
	int enumeration_count;
	struct enum_value *enum_value; /* of all enumerations, one behind the other */
	int enum_value_count;
	bool ranges;            /* a declaration has a subrange                */
	const char **used;      /* paths of files named by USES                */
	int used_count;
	const char **included;  /* the same of INCLUDE, also in files that are named */
	int included_count;
	struct source_file *source; /* one; plain IEC text may have more       */
	int source_count;
	struct part *part;
	int part_count;
};

/** project_new - an empty project.
 * Owns: the caller, project_free().   Fails: NULL when memory is out. */
struct project *project_new(const char *file);
void project_free(struct project *project);

/* Rungs of a POU: @at 0-based. The project takes over the rung it is given. */
bool project_add_rung(struct pou *pou, int at, struct rung *rung);
/** project_take_rung - removes a rung; the caller owns it. */
struct rung *project_take_rung(struct pou *pou, int at);
/** project_areas - sizes of this project's areas: from its configuration, or the usual
 * ones. Fails: false if they are too large together. */
bool project_areas(const struct project *project, struct areas *out);
/** project_has - whether an address is inside the areas; true for AREA_NONE. For many
 * addresses use areas_have(). */
bool project_has(const struct project *project, struct iec_addr addr);
/** pou_has_frame - whether it is a FUNCTION or FUNCTION_BLOCK: called with parameters,
 * its variables in a frame or instance. */
bool pou_has_frame(const struct pou *pou);
/** pou_has_any_bounds - a function or a block with ARRAY[*]: check/generic.h. Scan-safe: yes. */
bool pou_has_any_bounds(const struct pou *pou);
/** pou_boxed - the statements of the EXECUTE box at a cell, 0-based; NULL: there are none. */
const struct boxed *pou_boxed(const struct pou *pou, int rung, int row, int col);
/** project_view - the text from VIEW to END_VIEW of the file itself; "" if it has none. */
const char *project_view(const struct project *project);
/** project_view_is_last - whether the view is the last part. */
bool project_view_is_last(const struct project *project);
/** project_set_view - replaces the view; a new one becomes the last part; "" removes it.
 * @text is copied. Fails: false: no memory, nothing changed. */
bool project_set_view(struct project *project, const char *text);
/** pou_owner - number of the POU that has the action @pou; -1: there is none. Scan-safe: yes. */
int pou_owner(const struct project *project, const struct pou *pou);
/** pou_own_name - the name of an action without that of its owner; of others their name. */
const char *pou_own_name(const struct project *project, const struct pou *pou);
/** pou_word - PROGRAM, FUNCTION, FUNCTION_BLOCK, SUBROUTINE. Static. */
const char *pou_word(enum pou_kind kind);
/** pou_language_word - LD, IL, SFC, ST, FBD. Static. */
const char *pou_language_word(enum pou_language language);
/** project_is_further - has a PROGRAM line before @entry, of the project's configuration, the
 * same program? Then this instance has data of its own, and is called by its own name.
 * Scan-safe: no. */
bool project_is_further(struct project *project, const struct config_entry *entry);
/** project_called - the name of the program that calls block @index of `(Pump WITH Fast)` of a PROGRAM line, `Main.Pump()`: such
 * programs are there while the project is translated. Scan-safe: no. */
uint32_t project_called(struct project *project, const struct config_entry *entry, int index);
/** project_find_pou - index of the POU with this name, in any case; -1: none. @len: bytes. */
int project_find_pou(const struct project *project, const char *name, size_t len);
/** project_has_head - whether it has a title or a property. */
bool project_has_head(const struct project *project);
/** project_text - the string of an id. */
const char *project_text(const struct project *project, uint32_t id);

/** access_block_of - the block that contains line @index of project.access. */
const struct access_block *access_block_of(const struct project *project, int index);
/** access_word - READ_WRITE or READ_ONLY. Static. */
const char *access_word(bool writes);

/** project_write_type - the type of @var as declared: ARRAY[1..Limit] OF STRING[20].
 * Scan-safe: no. */
void project_write_type(const struct project *project, const struct var *var,
			const struct sink *sink);

/** project_print_type - the same as a text, cut where @out ends. */
void project_print_type(const struct project *project, const struct var *var, char *out, size_t size);

/** project_struct_begin, project_struct_end - STRUCT and END_STRUCT, or the words of a union. Static. */
const char *project_struct_begin(const struct structure *structure);
const char *project_struct_end(const struct structure *structure);
/** project_write_array - the `ARRAY[1..Limit] OF ` of it; nothing of a variable that is no array.
 * Scan-safe: no. */
void project_write_array(const struct project *project, const struct var *var, const struct sink *sink);

/** project_write_values - ` (In := 5, Out => Level)` of a PROGRAM line; nothing if it has none. Scan-safe: no. */
void project_write_values(const struct project *project, const struct config_entry *entry,
			  const struct sink *sink);
/** project_write_init - ` := ` and its initial value, if it has one of its own. Scan-safe: no. */
void project_write_init(const struct project *project, const struct var *var, const struct sink *sink);

/* The places of the parts of a project in its canonical text, for programs that replace
 * parts of it, as the editor does with declarations. */
enum text_part {
	TEXT_PART,  /* number of the part, its comments too                   */
	TEXT_POU,   /* number of the POU, from its heading to END_…           */
	TEXT_BLOCK, /* VAR … END_VAR; number in its table                     */
	TEXT_VAR,   /* one declaration, its newline too; number in its table  */
	TEXT_BODY,  /* of a POU: its rungs or its list; number of the POU     */
	TEXT_RUNG,  /* number in its POU                                      */
	TEXT_STRUCT, /* a structure; number in the project. Behind them the other types
			with names, each with one TEXT_VAR 0                  */
	TEXT_TITLE, /* PROJECT "…" and the properties, or the place for them  */
	TEXT_ENTRY, /* a line of the CONFIGURATION, its comments too; its number */
	TEXT_RESOURCE, /* from RESOURCE to END_RESOURCE                       */
	TEXT_STEP,  /* of a chart, from its comments to END_STEP; its number  */
	TEXT_TRANSITION, /* likewise                                          */
	TEXT_ACTION,
	TEXT_ACCESS, /* VAR_ACCESS … END_VAR; number of its block              */
	TEXT_ACCESS_LINE, /* one of its lines; number in the project          */
};
struct text_span {
	enum text_part part;
	int number;         /* 0-based                                        */
	int pou;            /* that contains it; -1: none                     */
	int structure;      /* likewise                                       */
	size_t at, len;     /* bytes                                          */
};
#endif
