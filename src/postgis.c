/* postgis.c - see postgis.h */
#include "postgis.h"

#include "catalog/pg_type.h"
#include "parser/parse_func.h"
#include "utils/builtins.h"
#include "utils/lsyscache.h"

#include "srid.h"

static Oid
function_of_postgis(const char *name, int arguments, const Oid *types)
{
	char *schema = get_namespace_name(ty_schema_of_type(types[0]));

	return LookupFuncName(list_make2(makeString(schema), makeString(pstrdup(name))), arguments, types, false);
}

bool
ty_is_valid(Datum polygon, Oid geometry_type)
{
	Oid function = function_of_postgis("st_isvalidreason", 1, &geometry_type);
	char *reason = text_to_cstring(DatumGetTextPP(OidFunctionCall1(function, polygon)));
	bool valid = strcmp(reason, "Valid Geometry") == 0;

	pfree(reason);
	return valid;
}

Datum
ty_simplified(Datum polygon, double tolerance, Oid geometry_type)
{
	Oid types[2] = {geometry_type, FLOAT8OID};

	return OidFunctionCall2(function_of_postgis("st_simplifypreservetopology", 2, types), polygon,
							Float8GetDatum(tolerance));
}
