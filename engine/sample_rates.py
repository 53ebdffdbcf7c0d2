"""Rates of the sample area: which landmarks stand in which zone, and on which grounds."""

from __future__ import annotations

ATTRIBUTION = (
    "Synthetic: a made-up town, no real place. Landmark rates after OpenStreetMap, "
    "(c) OpenStreetMap contributors, ODbL 1.0"
)

# Landmarks per square kilometre of zone. Condensed and rounded from counts of OpenStreetMap tags
# by zone in Liechtenstein, Helsinki, Monaco and Prattville ((c) OpenStreetMap contributors, ODbL
# 1.0; zones after the ACT Territory Plan); rare tags and those of SITES are left out.
RATES_PER_KM2 = {
    "Residential": "building=yes 740, natural=tree 360, building=house 53, highway=crossing 48, "
    "building=residential 47, building=apartments 33, building=detached 18, "
    "leisure=swimming_pool 17, public_transport=stop_position 15, highway=bus_stop 13, "
    "amenity=parking 12, barrier=bollard 11, building=garage 9, amenity=restaurant 7, "
    "office=company 4, building=shed 4, shop=clothes 3, building=construction 3, "
    "public_transport=platform 3, highway=give_way 3, amenity=bench 2, highway=street_lamp 2, "
    "highway=turning_circle 2, amenity=post_box 2, shop=hairdresser 1.5, amenity=cafe 1.3, "
    "tourism=hotel 1.4, building=church 1, shop=bakery 0.5, shop=convenience 0.5",
    "Commercial": "building=yes 490, natural=tree 270, amenity=restaurant 150, "
    "highway=crossing 94, shop=clothes 89, amenity=parking 82, office=company 61, "
    "amenity=cafe 54, amenity=fast_food 46, highway=bus_stop 33, man_made=surveillance 33, "
    "amenity=pub 33, building=commercial 31, shop=jewelry 24, shop=hairdresser 24, "
    "tourism=artwork 19, amenity=bench 18, amenity=bar 18, tourism=hotel 16, amenity=bank 16, "
    "shop=optician 15, amenity=waste_basket 15, shop=furniture 14, shop=cosmetics 13, "
    "amenity=atm 12, amenity=bicycle_parking 12, building=roof 11, shop=supermarket 10, "
    "amenity=doctors 10, shop=books 10, building=house 9, building=apartments 9, "
    "shop=bakery 9, building=office 8, shop=shoes 8, amenity=fountain 8, amenity=pharmacy 7, "
    "highway=traffic_signals 6, amenity=post_box 5",
    "Industrial": "building=yes 140, building=industrial 97, natural=tree 38, "
    "amenity=parking 23, highway=crossing 15, building=commercial 8, railway=level_crossing 8, "
    "highway=bus_stop 7, man_made=mast 4, building=office 3, amenity=fuel 3, building=roof 2, "
    "highway=give_way 2, shop=car 2, office=company 1, amenity=recycling 1, "
    "amenity=fire_station 1, amenity=car_wash 0.8, building=warehouse 0.4",
    "CommunityFacility": "natural=tree 610, building=yes 170, highway=crossing 68, "
    "amenity=parking 49, barrier=gate 22, amenity=vending_machine 22, man_made=flagpole 16, "
    "emergency=fire_hydrant 16, emergency=siren 16, tourism=artwork 14, "
    "amenity=bicycle_parking 14, amenity=library 14, building=entrance 11, "
    "barrier=lift_gate 5, amenity=cafe 5, leisure=playground 5",
    "ParksAndRecreation": "natural=tree 380, amenity=bench 140, building=yes 91, "
    "highway=street_lamp 89, natural=stone 60, tourism=artwork 44, amenity=waste_basket 23, "
    "barrier=gate 16, amenity=fountain 13, amenity=parking 11, historic=memorial 11, "
    "tourism=information 10, amenity=toilets 6, amenity=drinking_water 6, "
    "leisure=picnic_table 4, amenity=restaurant 3, building=hut 2, shop=kiosk 3",
    "TransportAndServices": "railway=signal 120, building=yes 61, highway=crossing 39, "
    "railway=level_crossing 33, railway=switch 17, highway=bus_stop 11, "
    "emergency=fire_hydrant 6, building=warehouse 6",
    "NonUrban": "natural=tree 35, building=yes 10, amenity=bench 1, tourism=information 0.8, "
    "power=pole 0.5, leisure=fitness_station 0.4, building=hut 0.2, building=greenhouse 0.1",
    "Military": "natural=tree 100, building=yes 60, barrier=gate 40",
}
ENVIRONMENTS = tuple(RATES_PER_KM2)

# What every site of a kind has on its grounds; "+" joins the tags of one landmark.
SITES = {
    "school": "amenity=school+building=school 1, building=school 4, playground=structure 1",
    "hospital": "amenity=hospital+building=hospital 1, building=hospital 5, amenity=doctors 3, "
    "amenity=pharmacy 1",
    "church": "amenity=place_of_worship+building=church 1, historic=memorial 1",
    "town park": "leisure=playground 1, playground=slide 2, playground=springy 3",
    "sports ground": "building=stadium 1, leisure=fitness_station 3, amenity=drinking_water 2",
    "small park": "leisure=playground 1, playground=swing 1, playground=slide 1",
    "station": "railway=station+building=train_station 1, public_transport=platform 4, "
    "railway=stop 4, amenity=taxi 1, amenity=bicycle_parking 2",
    "substation": "power=substation 1, power=transformer 5, building=transformer_tower 1, "
    "building=service 2",
    "barracks": "building=barracks 8, military=checkpoint 1, man_made=flagpole 2",
    "farm": "building=farm 1, building=barn 2, building=shed 1, building=farm_auxiliary 2, "
    "man_made=silo 1",
}
# Where things stand: shops in buildings, crossings at the kerb.
INDOOR_KEYS = {"shop", "office"}
INDOOR_VALUES = set(
    "restaurant cafe fast_food pub bar bank doctors pharmacy atm library hotel kiosk".split()
)
STREET_KEYS = {"highway", "public_transport", "barrier", "emergency"}
STREET_VALUES = {"level_crossing", "post_box", "pole", "surveillance"}


def amounts(text: str) -> dict[str, float]:
    """Read one line of the tables above.

    >>> amounts("natural=tree 35, amenity=school+building=school 1")
    {'natural=tree': 35.0, 'amenity=school+building=school': 1.0}
    """
    pairs = (item.rsplit(" ", 1) for item in text.split(", "))
    return {tags: float(amount) for tags, amount in pairs}
