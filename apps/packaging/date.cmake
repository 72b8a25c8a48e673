# date.cmake - sets one date for the packages and all files in them, so that the same sources give the same bytes:
# SOURCE_DATE_EPOCH, or else the day below. Renew the day with each version. CPack reads this file before it begins.
if(NOT DEFINED ENV{SOURCE_DATE_EPOCH})
  set(ENV{SOURCE_DATE_EPOCH} 1795305600) # 22 November 2026
endif()
