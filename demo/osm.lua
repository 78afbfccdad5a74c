-- osm.lua: osm2pgsql's flex output for the demo: building polygons and roads, as they are (lon/lat)

local buildings = osm2pgsql.define_table({
	name = 'raw_buildings',
	ids = { type = 'any', id_column = 'osm_id', type_column = 'osm_type' },
	columns = { { column = 'class', type = 'text' }, { column = 'geom', type = 'geometry', projection = 4326 } },
})

local roads = osm2pgsql.define_way_table('raw_roads', {
	{ column = 'class', type = 'text' }, { column = 'geom', type = 'linestring', projection = 4326 },
})

local function is_building(tags)
	return tags.building and tags.building ~= 'no'
end

function osm2pgsql.process_way(object)
	if object.is_closed and is_building(object.tags) then
		buildings:insert({ class = object.tags.building, geom = object:as_polygon() })
	elseif object.tags.highway and not (object.is_closed and object.tags.area == 'yes') then
		roads:insert({ class = object.tags.highway, geom = object:as_linestring() })
	end
end

function osm2pgsql.process_relation(object)
	if object.tags.type == 'multipolygon' and is_building(object.tags) then
		buildings:insert({ class = object.tags.building, geom = object:as_multipolygon() })
	end
end
