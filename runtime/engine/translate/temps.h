/* SPDX-License-Identifier: MIT
 *
 * temps - names for values of a ladder that have no name.
 *
 * _Tn: a BOOL inside one rung, reused by the next; _Nn: a number likewise; _En: the memory
 * of an edge; _Pn: power of a cell while watched. Users cannot declare such names in LD.
 */
#ifndef TRANSLATE_TEMPS_H
#define TRANSLATE_TEMPS_H

#include "engine/translate/translate.h"

/* One that holds a structure or array. */
struct temp_whole { const struct var *var; bool used; };

/* A variable of a chart whose value a changed program takes over (scan/carry.h): its key, with
 * a blank. */
struct temp_memory { const struct var *var; const char *key; };

struct temps {
	struct translation *translation;
	struct unit *unit;
	int bools, edges, powers;         /* used: in the rung, in the POU    */
	int numbers[IEC_TYPE_COUNT];      /* used in the rung, by type        */
	uint32_t *bool_name, *edge_name, *power_name;
	int bool_count, edge_count, power_count;
	uint32_t *number_name[IEC_TYPE_COUNT];
	int number_count[IEC_TYPE_COUNT];
	const char **edge_key;            /* what each _En remembers          */
	int edge_key_count;
	int numbers_made;
	struct temp_whole *whole;
	int whole_count;
	struct temp_memory *memory;
	int memory_count;
};

/** temps_named - declares a variable like @like under a name of its own. Its string id; 0:
 * no memory. */
uint32_t temps_named(struct temps *temps, const char *name, const struct var *like);
/** temps_remember - gives the last declared variable a key as well, which is copied. Fails:
 * false: no memory. */
bool temps_remember(struct temps *temps, const char *key);
/** temps_rung - temporaries of one rung may be used again. */
void temps_rung(struct temps *temps);
/* The next name of its kind, a string id; 0 when memory is out. */
uint32_t temps_bool(struct temps *temps);
/* @key: what it remembers, in the arena of the result; NULL: no memory. */
uint32_t temps_edge(struct temps *temps, const char *key);
uint32_t temps_power(struct temps *temps);
uint32_t temps_number(struct temps *temps, enum iec_type type);
/* The same for a structure or array like @m. */
uint32_t temps_whole(struct temps *temps, const struct meaning *m);
#endif
